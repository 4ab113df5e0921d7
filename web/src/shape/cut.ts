// The cuts of a merge tree: src/segment/cut.cpp again, number for number. Change both together;
// cut.test.ts compares them.
import type { MergeTree, Vec3 } from './format';
import { UnionFind } from './union_find';

export interface Neighbor {
  part: number;
  /** Radius of the largest ball through which the two are joined, in units of the input. */
  neckRadius: number;
}

export interface Part {
  volume: number;
  /** Volume-weighted mean: the paper's representative point. */
  center: Vec3;
  /** Of the volume: xx, xy, xz, yy, yz, zz. */
  covariance: readonly number[];
  ballRadius: number;
  pointCount: number;
  neighbors: Neighbor[];
}

/** One cut; parts are numbered by decreasing volume. */
export interface Parts {
  parts: Part[];
  /** (p) */
  partOfPiece: Int32Array;
}

/** A number of parts that some cut gives, and the merge ratios between which it does. */
export interface Level {
  parts: number;
  fromRatio: number;
  /** Infinite for the coarsest. */
  toRatio: number;
}

/** Coarsest first. */
export function findLevels(tree: MergeTree): Level[] {
  const levels: Level[] = [];
  let parts = tree.objects;
  let to = Infinity;
  for (let i = tree.mergeRatio.length - 1; i >= 0; --i) {
    if (!tree.mergeSignificant[i]) continue;
    const ratio = tree.mergeRatio[i];
    if (ratio < to) levels.push({ parts, fromRatio: ratio, toRatio: to });
    to = ratio;
    ++parts;
  }
  if (to > 1) levels.push({ parts, fromRatio: 1, toRatio: to });
  return levels;
}

/** Cuts at a merge ratio. Cost: O(p). */
export function cut(tree: MergeTree, mergeRatio: number): Parts {
  const groups = new UnionFind(tree.count);
  for (let i = 0; i < tree.mergeRatio.length; ++i) {
    if (!tree.mergeSignificant[i] || tree.mergeRatio[i] <= mergeRatio) {
      groups.join(tree.mergeA[i], tree.mergeB[i]);
    }
  }
  const { partOfPiece, count } = numberParts(tree, groups);
  const parts = measureParts(tree, partOfPiece, count);
  connectParts(tree, partOfPiece, parts);
  return { parts, partOfPiece };
}

function numberParts(tree: MergeTree, groups: UnionFind) {
  const volume = new Float64Array(tree.count);
  const roots: number[] = [];
  for (let b = 0; b < tree.count; ++b) {
    volume[groups.root(b)] += tree.moments[10 * b];
    if (groups.root(b) === b) roots.push(b);
  }
  roots.sort((a, b) => volume[b] - volume[a]);
  const partOfRoot = new Int32Array(tree.count);
  roots.forEach((root, part) => (partOfRoot[root] = part));
  const partOfPiece = new Int32Array(tree.count);
  for (let b = 0; b < tree.count; ++b) partOfPiece[b] = partOfRoot[groups.root(b)];
  return { partOfPiece, count: roots.length };
}

function measureParts(tree: MergeTree, partOfPiece: Int32Array, count: number): Part[] {
  const sums = new Float64Array(10 * count);
  const ballRadius = new Float64Array(count);
  const pointCount = new Uint32Array(count);
  for (let b = 0; b < tree.count; ++b) {
    const part = partOfPiece[b];
    for (let i = 0; i < 10; ++i) sums[10 * part + i] += tree.moments[10 * b + i];
    ballRadius[part] = Math.max(ballRadius[part], tree.ballRadius[b]);
    pointCount[part] += tree.pointCount[b];
  }
  return Array.from({ length: count }, (_, part) => ({
    ...finishMoments(sums.subarray(10 * part, 10 * part + 10), tree.origin),
    ballRadius: ballRadius[part],
    pointCount: pointCount[part],
    neighbors: [],
  }));
}

// Centre and covariance from sums about the origin of the moments.
function finishMoments(sum: Float64Array, origin: Vec3) {
  const volume = sum[0];
  if (volume <= 0) return { volume, center: [0, 0, 0] as Vec3, covariance: [0, 0, 0, 0, 0, 0] };
  const [x, y, z] = [1, 2, 3].map((i) => (1 / volume) * sum[i]);
  const squares = [x * x, x * y, x * z, y * y, y * z, z * z];
  return {
    volume,
    center: [origin[0] + x, origin[1] + y, origin[2] + z] as Vec3,
    covariance: squares.map((square, i) => sum[4 + i] / volume - square),
  };
}

function connectParts(tree: MergeTree, partOfPiece: Int32Array, parts: Part[]): void {
  const necks = new Map<number, number>();
  for (let i = 0; i < tree.neckRadius.length; ++i) {
    const a = partOfPiece[tree.neckA[i]];
    const b = partOfPiece[tree.neckB[i]];
    if (a === b) continue;
    const key = Math.min(a, b) * parts.length + Math.max(a, b);
    necks.set(key, Math.max(necks.get(key) ?? 0, tree.neckRadius[i]));
  }
  for (const [key, neckRadius] of necks) {
    const a = Math.floor(key / parts.length);
    const b = key % parts.length;
    parts[a].neighbors.push({ part: b, neckRadius });
    parts[b].neighbors.push({ part: a, neckRadius });
  }
  for (const part of parts) part.neighbors.sort((a, b) => a.part - b.part);
}
