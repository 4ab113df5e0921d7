// A shape and its cuts, as the viewer asks for them.
import { cut, findLevels, type Level, type Parts } from './cut';
import type { Shape, Vec3 } from './format';
import { leadersOf, rankLeaders } from './leaders';

/** One cut with the colours of its parts. */
export interface View extends Parts {
  level: number;
  /** The piece that leads each part: its name across cuts. */
  leaders: Uint32Array;
  /** 0 … 1 a channel. */
  colors: Vec3[];
  /** Of all parts. */
  volume: number;
  pointCount: number;
}

export class Model {
  readonly levels: Level[];
  /** The level at which the program cut. */
  readonly firstLevel: number;
  private readonly rank: Float64Array;

  constructor(readonly shape: Shape) {
    this.levels = findLevels(shape.tree);
    const found = this.levels.findIndex((level) => level.fromRatio <= shape.mergeRatio);
    this.firstLevel = found < 0 ? this.levels.length - 1 : found;
    this.rank = rankLeaders(shape.tree, cut(shape.tree, shape.mergeRatio), shape.mergeRatio);
  }

  /** Cost: O(p). */
  view(level: number): View {
    const { tree, palette } = this.shape;
    const parts = cut(tree, this.levels[level].fromRatio);
    const leaders = leadersOf(parts, this.rank);
    return {
      ...parts,
      level,
      leaders,
      colors: Array.from(leaders, (piece) => {
        const color = palette[this.rank[piece] % palette.length];
        return color.map((channel) => channel / 255) as unknown as Vec3;
      }),
      volume: parts.parts.reduce((sum, part) => sum + part.volume, 0),
      pointCount: parts.parts.reduce((sum, part) => sum + part.pointCount, 0),
    };
  }

  /** Where a point of the input is drawn. */
  drawn(p: Vec3): Vec3 {
    const { center, scale } = this.shape;
    return [(p[0] - center[0]) / scale, (p[1] - center[1]) / scale, (p[2] - center[2]) / scale];
  }
}
