// The cuts of this folder against those of C++, on pages that tests/viewer/write_pages.cpp writes.
import { readFileSync } from 'node:fs';
import { isDeepStrictEqual } from 'node:util';
import { describe, expect, test } from 'vitest';
import { cut, findLevels } from './cut';
import { parseShape, type Shape } from './format';
import { leadersOf, rankLeaders } from './leaders';
import { Model } from './model';

const folder = process.env.MORSEL_PAGES;

function shapeOfPage(name: string): Shape {
  const page = readFileSync(`${folder}/${name}.html`, 'utf8');
  return parseShape(/<script type="application\/json" id="shape">([^<]*)</.exec(page)![1]);
}

interface LevelOfCpp {
  parts: number;
  fromRatio: number;
  toRatio: number | null;
  partOfPiece: number[];
  measures: unknown[];
}

describe.skipIf(!folder)('as C++ does', () => {
  for (const name of ['random_tree', 'single_piece', 'dumbbell', 'paper']) {
    test(name, () => {
      const { tree } = shapeOfPage(name);
      const expected: LevelOfCpp[] = JSON.parse(readFileSync(`${folder}/${name}.json`, 'utf8'));
      const levels = findLevels(tree);
      expect(levels.length).toBe(expected.length);
      levels.forEach((level, i) => {
        const { parts, fromRatio, toRatio, partOfPiece, measures } = expected[i];
        expect(level).toEqual({ parts, fromRatio, toRatio: toRatio ?? Infinity });
        const own = cut(tree, level.fromRatio);
        expect(Array.from(own.partOfPiece)).toEqual(partOfPiece);
        expect(isDeepStrictEqual(own.parts, measures)).toBe(true);
      });
    });
  }

  test('every point has its piece and the counts agree', () => {
    const { points, tree } = shapeOfPage('random_tree');
    const counts = new Uint32Array(tree.count);
    points.pieces.forEach((piece) => ++counts[piece]);
    expect(counts).toEqual(tree.pointCount);
  });
});

describe.skipIf(!folder)('leaders', () => {
  test('number the first cut and stay while parts split off', () => {
    for (const name of ['random_tree', 'dumbbell']) {
      const shape = shapeOfPage(name);
      const first = cut(shape.tree, shape.mergeRatio);
      const rank = rankLeaders(shape.tree, first, shape.mergeRatio);
      const ranksOf = (level: number) => {
        const parts = cut(shape.tree, level);
        return Array.from(leadersOf(parts, rank), (piece) => rank[piece]);
      };
      expect(ranksOf(shape.mergeRatio)).toEqual(first.parts.map((_, part) => part));
      let coarser = new Set<number>();
      for (const level of findLevels(shape.tree)) {
        const ranks = ranksOf(level.fromRatio);
        const set = new Set(ranks);
        expect(set.size).toBe(level.parts);
        expect(ranks.every(Number.isFinite)).toBe(true);
        expect([...coarser].every((leader) => set.has(leader))).toBe(true);
        coarser = set;
      }
    }
  });

  test('the first view has the colours of the palette in order', () => {
    const model = new Model(shapeOfPage('random_tree'));
    const { colors, parts } = model.view(model.firstLevel);
    const { palette } = model.shape;
    expect(parts.length).toBeGreaterThan(palette.length);
    colors.forEach((color, part) => {
      const expected = palette[part % palette.length].map((channel) => channel / 255);
      expect(color).toEqual(expected);
    });
  });
});
