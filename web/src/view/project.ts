// Points on the screen, reckoned by the processor: which part is under the pointer, and where a
// part shows itself best.
import type { Points } from '../shape/format';

/** Where and how the points are drawn. */
export interface Projection {
  /** World to clip space, column by column. */
  matrix: ArrayLike<number>;
  /** Of the canvas, in CSS pixels. */
  width: number;
  height: number;
  /** Of one unit at distance 1, in CSS pixels. */
  pixels: number;
}

/** What is drawn of each part. */
export interface Placement {
  partOfPiece: Int32Array;
  /** (parts, 3) */
  offsets: Float32Array;
  /** (parts) 0: hidden */
  shown: Uint8Array;
}

type Visit = (part: number, x: number, y: number, depth: number, point: number) => void;

// Calls `visit` for every `stride`-th shown point in front of the camera; depth is the distance.
function project(
  points: Points,
  placement: Placement,
  projection: Projection,
  stride: number,
  visit: Visit,
): void {
  const { positions, pieces } = points;
  const { partOfPiece, offsets, shown } = placement;
  const { matrix: m, width, height } = projection;
  for (let i = 0; i < points.count; i += stride) {
    if (pieces[i] >= partOfPiece.length) continue;
    const part = partOfPiece[pieces[i]];
    if (!shown[part]) continue;
    const x = positions[3 * i] / 32767.5 - 1 + offsets[3 * part];
    const y = positions[3 * i + 1] / 32767.5 - 1 + offsets[3 * part + 1];
    const z = positions[3 * i + 2] / 32767.5 - 1 + offsets[3 * part + 2];
    const w = m[3] * x + m[7] * y + m[11] * z + m[15];
    if (w <= 0) continue;
    const clipX = (m[0] * x + m[4] * y + m[8] * z + m[12]) / w;
    const clipY = (m[1] * x + m[5] * y + m[9] * z + m[13]) / w;
    visit(part, (0.5 + 0.5 * clipX) * width, (0.5 - 0.5 * clipY) * height, w, i);
  }
}

/** The part that is seen at a place of the canvas, or null. Cost: O(n), some milliseconds. */
export function partAt(
  points: Points,
  placement: Placement,
  projection: Projection,
  x: number,
  y: number,
): number | null {
  const unit = (points.longestRadius / 255) * projection.pixels;
  let best: number | null = null;
  let nearest = Infinity;
  project(points, placement, projection, 1, (part, px, py, depth, i) => {
    const radius = Math.max(2, (points.radii[2 * i] * unit) / depth);
    if (depth >= nearest || (px - x) ** 2 + (py - y) ** 2 > radius * radius) return;
    nearest = depth;
    best = part;
  });
  return best;
}

export interface Anchor {
  part: number;
  x: number;
  y: number;
  depth: number;
}

const kCell = 5; // CSS pixels
const kEnoughPoints = 12_000;
const kMostRadius = 40; // CSS pixels
const kLeastReach = 2; // cells around an anchor that show its part

/**
 * For each part that shows itself widely enough the place furthest inside what is seen of it.
 * Cost: O(n + cells).
 */
export function findAnchors(
  points: Points,
  placement: Placement,
  projection: Projection,
): Anchor[] {
  const columns = Math.ceil(projection.width / kCell);
  const rows = Math.ceil(projection.height / kCell);
  const seen = new Int32Array(columns * rows).fill(-1);
  const depths = new Float32Array(columns * rows).fill(Infinity);
  const stride = Math.ceil(points.count / kEnoughPoints);
  // Fewer points are drawn larger, so that no gaps show what lies behind.
  const unit = (points.longestRadius / 255) * projection.pixels * Math.sqrt(stride);
  project(points, placement, projection, stride, (part, x, y, depth, i) => {
    const radius = Math.min(kMostRadius, (points.radii[2 * i] * unit) / depth);
    const left = Math.max(0, Math.floor((x - radius) / kCell));
    const right = Math.min(columns - 1, Math.floor((x + radius) / kCell));
    const top = Math.max(0, Math.floor((y - radius) / kCell));
    const bottom = Math.min(rows - 1, Math.floor((y + radius) / kCell));
    for (let row = top; row <= bottom; ++row) {
      for (let column = left; column <= right; ++column) {
        const cell = row * columns + column;
        if (depth >= depths[cell]) continue;
        depths[cell] = depth;
        seen[cell] = part;
      }
    }
  });
  const reach = reachWithin(seen, columns, rows);
  return deepest(seen, reach, depths, columns, placement.shown.length);
}

// Steps from each cell to the nearest one of another part or the edge, by two sweeps; diagonals
// count 1.4. Written out, as it is done for every frame.
function reachWithin(seen: Int32Array, columns: number, rows: number): Float32Array {
  const reach = new Float32Array(seen.length);
  const sweep = (row: number, column: number, forward: boolean) => {
    const cell = row * columns + column;
    const onEdge = row === 0 || column === 0 || row === rows - 1 || column === columns - 1;
    if (onEdge) {
      reach[cell] = 1;
      return;
    }
    const part = seen[cell];
    const step = forward ? -1 : 1;
    const ahead = cell + step * columns;
    const by = (other: number, length: number) =>
      seen[other] === part ? reach[other] + length : 1;
    let least = Math.min(by(cell + step, 1), by(ahead, 1));
    least = Math.min(least, by(ahead - 1, 1.4), by(ahead + 1, 1.4));
    reach[cell] = forward ? least : Math.min(reach[cell], least);
  };
  for (let row = 0; row < rows; ++row) {
    for (let column = 0; column < columns; ++column) sweep(row, column, true);
  }
  for (let row = rows - 1; row >= 0; --row) {
    for (let column = columns - 1; column >= 0; --column) sweep(row, column, false);
  }
  return reach;
}

function deepest(
  seen: Int32Array,
  reach: Float32Array,
  depths: Float32Array,
  columns: number,
  parts: number,
): Anchor[] {
  const best = new Int32Array(parts).fill(-1);
  seen.forEach((part, cell) => {
    if (part < 0 || reach[cell] < kLeastReach) return;
    if (best[part] < 0 || reach[cell] > reach[best[part]]) best[part] = cell;
  });
  const anchors: Anchor[] = [];
  best.forEach((cell, part) => {
    if (cell < 0) return;
    const x = ((cell % columns) + 0.5) * kCell;
    const y = (Math.floor(cell / columns) + 0.5) * kCell;
    anchors.push({ part, x, y, depth: depths[cell] });
  });
  return anchors;
}
