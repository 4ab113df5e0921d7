import { describe, expect, test } from 'vitest';
import type { Points } from '../shape/format';
import { spreadOrder } from './splats';
import { findAnchors, partAt, type Placement, type Projection } from './project';

// Looks down z, nearly without perspective; x and y of [-1, 1] fill the canvas.
const kProjection: Projection = {
  matrix: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, -0.001, 0, 0, 0, 1],
  width: 200,
  height: 200,
  pixels: 100,
};

function pointsAt(places: number[][], radius: number): Points {
  return {
    count: places.length,
    positions: Uint16Array.from(
      places.flatMap(([x, y, z]) => [x, y, z].map((c) => Math.round((c + 1) * 32767.5))),
    ),
    turns: new Int8Array(4 * places.length),
    radii: new Uint8Array(2 * places.length).fill(255),
    longestRadius: radius,
    pieces: Uint32Array.from(places, (place) => place[3]),
  };
}

function placementOf(parts: number): Placement {
  return {
    partOfPiece: Int32Array.from({ length: parts }, (_, i) => i),
    offsets: new Float32Array(3 * parts),
    shown: new Uint8Array(parts).fill(1),
  };
}

describe('partAt', () => {
  const points = pointsAt(
    [
      [0, 0, -0.5, 0],
      [0.02, 0, 0.5, 1],
      [0.5, 0.5, 0, 2],
    ],
    0.05,
  );

  test('takes the nearest', () => {
    expect(partAt(points, placementOf(3), kProjection, 101, 100)).toBe(1);
    expect(partAt(points, placementOf(3), kProjection, 150, 50)).toBe(2);
    expect(partAt(points, placementOf(3), kProjection, 20, 20)).toBeNull();
  });

  test('passes over what is hidden, follows what was moved', () => {
    const placement = placementOf(3);
    placement.shown[1] = 0;
    expect(partAt(points, placement, kProjection, 101, 100)).toBe(0);
    placement.offsets.set([0.5, 0, 0], 0);
    expect(partAt(points, placement, kProjection, 150, 100)).toBe(0);
    expect(partAt(points, placement, kProjection, 101, 100)).toBeNull();
  });

  test('points without a piece are no part', () => {
    const lost = pointsAt([[0, 0, 0, 3]], 0.05);
    expect(partAt(lost, placementOf(3), kProjection, 100, 100)).toBeNull();
  });
});

describe('findAnchors', () => {
  // Two squares, the left one behind and partly hidden by the right one.
  const square = (x0: number, z: number, piece: number) =>
    Array.from({ length: 900 }, (_, i) => [
      x0 + 0.8 * ((i % 30) / 29),
      -0.4 + 0.8 * (Math.floor(i / 30) / 29),
      z,
      piece,
    ]);

  test('stand in the middle of what is seen', () => {
    const points = pointsAt([...square(-0.9, -0.5, 0), ...square(-0.3, 0.5, 1)], 0.02);
    const anchors = findAnchors(points, placementOf(2), kProjection);
    expect(anchors.map(({ part }) => part)).toEqual([0, 1]);
    expect(anchors[0].x).toBeGreaterThan(15);
    expect(anchors[0].x).toBeLessThan(65);
    expect(Math.abs(anchors[1].x - 110)).toBeLessThan(15);
    for (const { x, y, part } of anchors) {
      expect(partAt(points, placementOf(2), kProjection, x, y)).toBe(part);
    }
  });

  test('slivers have none', () => {
    const line = Array.from({ length: 100 }, (_, i) => [-0.9 + 0.018 * i, 0, 0, 0]);
    expect(findAnchors(pointsAt(line, 0.01), placementOf(1), kProjection)).toEqual([]);
  });
});

test('every beginning of the drawing order is spread over all points', () => {
  for (const count of [0, 1, 7, 512, 5000]) {
    const order = spreadOrder(count);
    expect([...order].sort((a, b) => a - b)).toEqual(Array.from({ length: count }, (_, i) => i));
  }
  const first = [...spreadOrder(5000).slice(0, 500)].sort((a, b) => a - b);
  const gaps = first.slice(1).map((index, i) => index - first[i]);
  expect(Math.max(...gaps)).toBeLessThanOrEqual(17);
});
