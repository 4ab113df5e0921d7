import { describe, expect, test } from 'vitest';
import { ballRadius, ellipsoidOf } from './ellipsoid';
import { counted, length, percent, safeName } from './text';
import { UnionFind } from './union_find';

describe('UnionFind', () => {
  test('joins by size, the first of equals stays', () => {
    const sets = new UnionFind(5);
    expect(sets.join(3, 1)).toBe(3);
    expect(sets.join(0, 1)).toBe(3);
    expect(sets.root(0)).toBe(3);
    expect(sets.root(4)).toBe(4);
    expect(sets.join(1, 0)).toBe(3);
  });
});

describe('ellipsoid', () => {
  test('of a box along the axes', () => {
    const { radii, axes } = ellipsoidOf([1, 0, 0, 4, 0, 9]);
    expect(radii).toEqual([Math.sqrt(45), Math.sqrt(20), Math.sqrt(5)]);
    expect(axes[0].map(Math.abs)).toEqual([0, 0, 1]);
  });

  test('axes and radii give the covariance back', () => {
    const covariance = [2, 0.6, -0.3, 1.5, 0.2, 1];
    const { axes, radii } = ellipsoidOf(covariance);
    const entry = (i: number, j: number) =>
      axes.reduce((sum, axis, k) => sum + (axis[i] * axis[j] * radii[k] ** 2) / 5, 0);
    const back = [entry(0, 0), entry(0, 1), entry(0, 2), entry(1, 1), entry(1, 2), entry(2, 2)];
    back.forEach((value, i) => expect(value).toBeCloseTo(covariance[i], 12));
    const [a, b, c] = axes;
    const volume =
      a[0] * (b[1] * c[2] - b[2] * c[1]) +
      a[1] * (b[2] * c[0] - b[0] * c[2]) +
      a[2] * (b[0] * c[1] - b[1] * c[0]);
    expect(volume).toBeCloseTo(1, 12);
  });

  test('of nothing has no extent', () => {
    expect(ellipsoidOf([0, 0, 0, 0, 0, 0]).radii).toEqual([0, 0, 0]);
    expect(ballRadius(-1)).toBe(0);
    expect(ballRadius((4 / 3) * Math.PI * 8)).toBeCloseTo(2, 12);
  });
});

describe('text', () => {
  test('shares', () => {
    const shares = [1, 0.413, 0.0996, 0.0413, 0.00996, 0.00413, 0.00001, 0, NaN];
    expect(shares.map(percent)).toEqual([
      '100%',
      '41%',
      '10%',
      '4.1%',
      '1.0%',
      '0.41%',
      '< 0.01%',
      '0%',
      '0%',
    ]);
  });

  test('lengths', () => {
    expect([0, 1.2345, 1234.5, 0.00012345].map(length)).toEqual(['0', '1.23', '1230', '0.000123']);
    expect([1.5e7, 2e-9].map(length)).toEqual(['1.50e+7', '2.00e-9']);
  });

  test('counts', () => {
    expect([counted(1, 'part'), counted(12345, 'point')]).toEqual(['1 part', '12,345 points']);
  });

  test('names of files', () => {
    expect(safeName('bull.off')).toBe('bull');
    expect(safeName('../<b>"x"\n.tar.gz')).toBe('b_x_.tar');
    expect(safeName('鯨.ply')).toBe('shape');
  });
});
