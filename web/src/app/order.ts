// Orders of the rows of a table of all pairs.
import type { Matrix } from './api';

export type Order = 'class' | 'name' | 'similarity';

/** The score of rows i and j. */
export const scoreOf = ({ scores }: Matrix, i: number, j: number) =>
  i >= j ? scores[i][j] : scores[j][i];

/** Indices of the shapes in the order that was asked for. */
export function orderBy(matrix: Matrix, order: Order): number[] {
  const indices = matrix.shapes.map((_, i) => i);
  const compare = (a: string, b: string) => (a < b ? -1 : a > b ? 1 : 0);
  const byName = (i: number, j: number) => compare(matrix.shapes[i].name, matrix.shapes[j].name);
  if (order === 'similarity') return orderBySimilarity(matrix);
  return indices.sort((i, j) =>
    order === 'name'
      ? byName(i, j)
      : compare(matrix.shapes[i].class, matrix.shapes[j].class) || byName(i, j),
  );
}

/**
 * Neighbours in this order are alike: groups are joined by their mean score, best pair first (as
 * found along chains of nearest neighbours), and laid end to end the better way round. Cost: O(n²).
 */
export function orderBySimilarity(matrix: Matrix): number[] {
  const count = matrix.shapes.length;
  const score = Array.from({ length: count }, (_, i) =>
    Float64Array.from({ length: count }, (_, j) => scoreOf(matrix, i, j)),
  );
  const leaves = matrix.shapes.map((_, i) => [i]);
  const open = new Set(leaves.keys());
  const chain: number[] = [];
  while (open.size > 1) {
    if (chain.length === 0) chain.push(open.values().next().value!);
    const top = chain[chain.length - 1];
    const nearest = nearestTo(top, chain[chain.length - 2], open, score);
    if (nearest !== chain[chain.length - 2]) {
      chain.push(nearest);
      continue;
    }
    chain.length -= 2;
    join(top, nearest, open, score, leaves);
    leaves[top] = endToEnd(leaves[top], leaves[nearest], matrix);
  }
  return open.size === 0 ? [] : leaves[open.values().next().value!];
}

// Ties go to the one before it in the chain, so that chains end, then to the smallest index.
function nearestTo(
  from: number,
  before: number | undefined,
  open: Set<number>,
  score: Float64Array[],
): number {
  let best = before ?? -1;
  for (const other of open) {
    if (other === from || other === best) continue;
    if (best < 0 || score[from][other] > score[from][best]) best = other;
  }
  return best;
}

// The scores of the two together, kept as those of `a`.
function join(
  a: number,
  b: number,
  open: Set<number>,
  score: Float64Array[],
  leaves: readonly number[][],
): void {
  const [na, nb] = [leaves[a].length, leaves[b].length];
  open.delete(b);
  for (const other of open) {
    if (other === a) continue;
    const mean = (na * score[a][other] + nb * score[b][other]) / (na + nb);
    score[a][other] = mean;
    score[other][a] = mean;
  }
}

function endToEnd(left: number[], right: number[], matrix: Matrix): number[] {
  const score = (i: number, j: number) => scoreOf(matrix, i, j);
  const end = (list: number[]) => list[list.length - 1];
  const ways: [number, number[], number[]][] = [
    [score(end(left), right[0]), left, right],
    [score(end(left), end(right)), left, [...right].reverse()],
    [score(left[0], right[0]), [...left].reverse(), right],
    [score(left[0], end(right)), [...left].reverse(), [...right].reverse()],
  ];
  const [, first, second] = ways.reduce((best, way) => (way[0] > best[0] ? way : best));
  return [...first, ...second];
}
