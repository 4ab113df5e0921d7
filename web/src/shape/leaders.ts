// Which piece leads each part, so that a part keeps its colour while others split off or join it.
import type { MergeTree } from './format';
import type { Parts } from './cut';
import { UnionFind } from './union_find';

/**
 * A rank for each piece that leads a part in some cut, infinite for the others; every part of every
 * cut is led by its piece of smallest rank. Part i of `first`, the cut at `mergeRatio`, is led by
 * rank i. Where a part splits, the larger side keeps the leader and the smaller gets the next
 * rank, so ranks depend on the tree and the first cut alone. Cost: O(p).
 */
export function rankLeaders(tree: MergeTree, first: Parts, mergeRatio: number): Float64Array {
  const groups = new UnionFind(tree.count);
  const volume = Float64Array.from({ length: tree.count }, (_, b) => tree.moments[10 * b]);
  const leader = Uint32Array.from({ length: tree.count }, (_, b) => b);
  // Joins two groups and returns the leader of the smaller, which leads no longer.
  const join = (i: number): number => {
    const a = groups.root(tree.mergeA[i]);
    const b = groups.root(tree.mergeB[i]);
    const [larger, smaller] = volume[a] >= volume[b] ? [a, b] : [b, a];
    const [kept, lost] = [leader[larger], leader[smaller]];
    const sum = volume[a] + volume[b];
    const root = groups.join(a, b);
    volume[root] = sum;
    leader[root] = kept;
    return lost;
  };
  const merges = Array.from(tree.mergeRatio.keys());
  for (const i of merges) if (!tree.mergeSignificant[i]) join(i);
  const finer = merges.filter((i) => tree.mergeSignificant[i] && tree.mergeRatio[i] <= mergeRatio);
  const lost = finer.map(join);
  const rank = new Float64Array(tree.count).fill(Infinity);
  for (let b = 0; b < tree.count; ++b) {
    if (groups.root(b) === b) rank[leader[b]] = first.partOfPiece[b];
  }
  lost.reverse().forEach((piece, i) => (rank[piece] = first.parts.length + i));
  // Coarser cuts need no more: there the largest part of the first cut leads.
  return rank;
}

/** The leading piece of each part. */
export function leadersOf(parts: Parts, rank: Float64Array): Uint32Array {
  const leaders = new Uint32Array(parts.parts.length);
  const best = new Float64Array(leaders.length).fill(Infinity);
  parts.partOfPiece.forEach((part, piece) => {
    if (rank[piece] >= best[part]) return;
    best[part] = rank[piece];
    leaders[part] = piece;
  });
  return leaders;
}
