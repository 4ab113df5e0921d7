// The ellipsoid that spreads as a part does.

export interface Ellipsoid {
  /** Unit axes, right-handed, each with its half length, longest first. */
  axes: readonly [number[], number[], number[]];
  radii: readonly [number, number, number];
}

/**
 * The solid ellipsoid of the given covariance (xx, xy, xz, yy, yz, zz): a uniform one has half axes
 * √(5 λ), λ the eigenvalues. Found by Jacobi's rotations.
 */
export function ellipsoidOf(covariance: readonly number[]): Ellipsoid {
  const [xx, xy, xz, yy, yz, zz] = covariance;
  const m = [
    [xx, xy, xz],
    [xy, yy, yz],
    [xz, yz, zz],
  ];
  const v = [
    [1, 0, 0],
    [0, 1, 0],
    [0, 0, 1],
  ];
  for (let sweep = 0; sweep < 12; ++sweep) {
    for (const [p, q] of [
      [0, 1],
      [0, 2],
      [1, 2],
    ]) {
      rotate(m, v, p, q);
    }
  }
  const order = [0, 1, 2].sort((a, b) => m[b][b] - m[a][a]);
  const axes = order.map((i) => v.map((row) => row[i]));
  axes[2] = cross(axes[0], axes[1]);
  const radii = order.map((i) => Math.sqrt(5 * Math.max(0, m[i][i])));
  return { axes: axes as [number[], number[], number[]], radii: radii as [number, number, number] };
}

// Makes m[p][q] zero.
function rotate(m: number[][], v: number[][], p: number, q: number): void {
  if (m[p][q] === 0) return;
  const theta = (m[q][q] - m[p][p]) / (2 * m[p][q]);
  const t = Math.sign(theta || 1) / (Math.abs(theta) + Math.hypot(theta, 1));
  const c = 1 / Math.hypot(t, 1);
  const s = t * c;
  for (let i = 0; i < 3; ++i)
    [m[i][p], m[i][q]] = [c * m[i][p] - s * m[i][q], s * m[i][p] + c * m[i][q]];
  for (let i = 0; i < 3; ++i)
    [m[p][i], m[q][i]] = [c * m[p][i] - s * m[q][i], s * m[p][i] + c * m[q][i]];
  for (let i = 0; i < 3; ++i)
    [v[i][p], v[i][q]] = [c * v[i][p] - s * v[i][q], s * v[i][p] + c * v[i][q]];
}

function cross(a: readonly number[], b: readonly number[]): number[] {
  return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
}

/** Radius of the ball of a volume. */
export function ballRadius(volume: number): number {
  return Math.cbrt((3 * Math.max(0, volume)) / (4 * Math.PI));
}
