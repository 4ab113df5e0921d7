// What the numbers mean, for people who have not read the paper.
import type { Match } from './api';
import { percent } from '../shape/text';

/** What each measure of the score looks at (docs/signature.md). */
const kMeasures: Record<string, string> = {
  shells: 'Where its surface lies around its middle',
  facing: 'Which ways its surface faces',
  pairs: 'Distances and angles across its surface',
  thickness: 'How thick it is, and where',
  centricity: 'How far its limbs reach from its body',
};

const kSteps: Record<string, string> = {
  '': 'Waiting for its turn',
  read: 'Reading the file',
  ground: 'Looking for the ground',
  denoise: 'Looking for stray and noisy points',
  triangulate: 'Joining neighbouring points',
  neighbors: 'Measuring the gaps between points',
  interior: 'Finding the inside',
  basins: 'Finding where it is thick',
  merge: 'Joining pieces to parts',
  cut: 'Choosing the parts',
  signature: 'Noting what it looks like',
  done: 'Drawing it',
};

export const stepText = (step: string) => kSteps[step] ?? step;

/** "0.71" */
export const scoreText = (score: number) => score.toFixed(2);

/** What a score says in words; unrelated shapes have about 0.37. */
export function verdict(score: number): string {
  if (score >= 0.999) return 'the same';
  if (score >= 0.75) return 'very alike';
  if (score >= 0.6) return 'alike';
  if (score >= 0.45) return 'somewhat alike';
  return 'hardly alike';
}

export interface Reason {
  text: string;
  adds: boolean;
  /** 0 … 1, how much of a bar to fill. */
  amount: number;
  value: string;
}

/** The measures that the score is made of, the strongest reason first. */
export function measuresOf(match: Match): Reason[] {
  return match.terms
    .filter(({ weight }) => weight > 0.01)
    .sort((a, b) => Math.abs(1 - b.distance) - Math.abs(1 - a.distance))
    .map(({ name, distance }) => ({
      text: kMeasures[name] ?? name,
      adds: distance < 1,
      amount: Math.min(1, Math.abs(1 - distance)),
      value: alike(distance),
    }));
}

function alike(distance: number): string {
  if (distance < 0.02) return 'the same';
  if (distance < 0.4) return 'very alike';
  if (distance < 0.75) return 'alike';
  if (distance < 1) return 'a little alike';
  if (distance < 1.3) return 'as different as most shapes';
  return 'very different';
}

const kFar = 0.02; // of the closest pair's closeness

export interface PartReason extends Reason {
  /** Parts of the query, for their colours; null: grey. */
  part: number | null;
}

/** Which parts lie on each other, and which on none. */
export function partsOf(match: Match): PartReason[] {
  const share = (shares: number[], part: number) => shares[part] ?? 0;
  // How closely two parts cover each other, whatever their sizes.
  const closeness = ({ target, source, contribution }: Match['matched'][number]) =>
    contribution / (share(match.target_shares, target) * share(match.source_shares, source));
  const closest = Math.max(...match.matched.map(closeness));
  const pairs = match.matched.map((pair) => {
    const { target, source, contribution } = pair;
    const adds = closeness(pair) > kFar * closest;
    return {
      part: target,
      text: adds
        ? `Part ${target} here lies on part ${source} there`
        : `Part ${target} here and part ${source} there are left, but lie apart`,
      adds,
      amount: adds ? contribution : share(match.target_shares, target),
      value: adds
        ? `${percent(contribution)} of all that is covered`
        : `${percent(share(match.target_shares, target))} of the volume`,
    };
  });
  const alone = (parts: number[], shares: number[], where: string, own: boolean) =>
    parts.map((part) => ({
      part: own ? part : null,
      text: `Part ${part} ${where} has no counterpart`,
      adds: false,
      amount: share(shares, part),
      value: `${percent(share(shares, part))} of the volume`,
    }));
  return [
    ...pairs.filter(({ adds }) => adds),
    ...pairs.filter(({ adds }) => !adds),
    ...alone(match.unmatched_target, match.target_shares, 'here', true),
    ...alone(match.unmatched_source, match.source_shares, 'there', false),
  ];
}

/** Folder and last part of a name that is a path. */
export function splitName(name: string): [string, string] {
  const at = name.lastIndexOf('/') + 1;
  return [name.slice(0, at), name.slice(at)];
}
