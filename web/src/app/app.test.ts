import { describe, expect, test } from 'vitest';
import type { Match, Matrix } from './api';
import { heatColor } from './heat_map';
import { compareLink, likeLink, pageOf, shapesLink } from './links';
import { orderBy, orderBySimilarity, scoreOf } from './order';
import { measuresOf, partsOf, splitName, verdict } from './words';

describe('addresses', () => {
  test('lead to the page that they were made for', () => {
    const name = 'a/b c&d=e#?ü.off';
    expect(pageOf(likeLink({ name }))).toEqual({ page: 'like', query: { name } });
    expect(pageOf(likeLink({ upload: 'ab' }))).toEqual({ page: 'like', query: { upload: 'ab' } });
    expect(pageOf(compareLink({ name }, 'x&y'))).toEqual({
      page: 'compare',
      query: { name },
      other: 'x&y',
    });
    expect(pageOf(shapesLink('t', ''))).toEqual({ page: 'shapes', text: 't', class: '' });
  });

  test('that are none of ours lead to the gallery', () => {
    for (const fragment of ['', '#', '#/', '#/nonsense', '#/like', '#/compare?name=a']) {
      expect(pageOf(fragment)).toEqual({ page: 'shapes', text: '', class: null });
    }
  });
});

// Scores of points on a line: the nearer, the more alike.
function lineMatrix(places: number[]): Matrix {
  return {
    shapes: places.map((x, i) => ({ name: `n${9 - i}`, class: x < 0 ? 'b' : 'a', tags: [] })),
    scores: places.map((x, i) => places.slice(0, i + 1).map((y) => Math.exp(-Math.abs(x - y)))),
  };
}

describe('orders', () => {
  const matrix = lineMatrix([0, 5, -3, 0.1, 5.2, -3.1, 0.2]);

  test('by class and by name', () => {
    expect(orderBy(matrix, 'name')).toEqual([6, 5, 4, 3, 2, 1, 0]);
    expect(orderBy(matrix, 'class')).toEqual([6, 4, 3, 1, 0, 5, 2]);
  });

  test('by similarity: neighbours on the line are neighbours in the order', () => {
    const places = [0, 5, -3, 0.1, 5.2, -3.1, 0.2];
    const order = orderBySimilarity(matrix).map((i) => places[i]);
    expect([...order].sort((a, b) => a - b)).toEqual([...places].sort((a, b) => a - b));
    const jumps = order.slice(1).map((x, i) => Math.abs(x - order[i]));
    expect(jumps.reduce((sum, jump) => sum + jump)).toBeLessThan(9);
  });

  test('by similarity: few, equal and many', () => {
    expect(orderBySimilarity(lineMatrix([]))).toEqual([]);
    expect(orderBySimilarity(lineMatrix([1]))).toEqual([0]);
    expect(orderBySimilarity(lineMatrix([1, 1, 1, 1])).sort()).toEqual([0, 1, 2, 3]);
    const many = lineMatrix(Array.from({ length: 300 }, (_, i) => Math.sin(i) * 50));
    expect(new Set(orderBySimilarity(many)).size).toBe(300);
  });

  test('scores are read from either side', () => {
    expect(scoreOf(matrix, 1, 4)).toBe(scoreOf(matrix, 4, 1));
  });
});

describe('words', () => {
  const match = {
    score: 0.6,
    matched: [
      { target: 0, source: 1, contribution: 0.8 },
      { target: 1, source: 0, contribution: 1e-9 },
    ],
    unmatched_target: [2],
    unmatched_source: [],
    target_shares: [0.7, 0.2, 0.1],
    source_shares: [0.3, 0.7],
    terms: [
      { name: 'shells', distance: 0.5, weight: 0.3 },
      { name: 'thickness', distance: 1.8, weight: 0.3 },
      { name: 'pairs', distance: 0.9, weight: 0.001 },
    ],
  } as unknown as Match;

  test('what adds and what takes away', () => {
    expect(measuresOf(match).map(({ adds }) => adds)).toEqual([false, true]);
    const parts = partsOf(match);
    expect(parts.map(({ adds }) => adds)).toEqual([true, false, false]);
    expect(parts[0].value).toBe('80% of all that is covered');
    expect(parts[2].text).toBe('Part 2 here has no counterpart');
  });

  test('verdicts fall with the score', () => {
    const said = [1, 0.8, 0.65, 0.5, 0.3].map(verdict);
    expect(new Set(said).size).toBe(5);
    expect(said[0]).toBe('the same');
  });

  test('names are split at the last slash', () => {
    expect(splitName('a/b/c.off')).toEqual(['a/b/', 'c.off']);
    expect(splitName('c.off')).toEqual(['', 'c.off']);
  });
});

test('the heat map goes from dark to bright', () => {
  const light = (score: number) =>
    heatColor(score)
      .match(/\d+/g)!
      .reduce((sum, channel) => sum + Number(channel), 0);
  const steps = [0, 0.25, 0.5, 0.75, 1].map(light);
  expect(steps).toEqual([...steps].sort((a, b) => a - b));
  expect(heatColor(-1)).toBe(heatColor(0));
  expect(heatColor(2)).toBe(heatColor(1));
});
