// Why two shapes score as they do: both in one pose, the measures of the whole, the parts.
import { make } from '../ui/dom';
import { swatch } from '../ui/part_card';
import type { Picture } from '../shape/format';
import type { Match } from './api';
import { nameOf } from './parts_of_page';
import { measuresOf, partsOf, scoreText, verdict, type Reason } from './words';

const kGrey = [0.63, 0.63, 0.63];
const kMostParts = 30;

/** `query`: of the other shape's query, for the colours. */
export function explain(match: Match, query: Picture): HTMLElement {
  const parts = partsOf(match);
  const colorOf = (part: number | null) =>
    part === null
      ? kGrey
      : query.palette[part % query.palette.length].map((channel) => channel / 255);
  const hidden = parts.length - kMostParts;
  return make(
    'div',
    { class: 'reasons' },
    make(
      'p',
      {},
      make('b', {}, `Score ${scoreText(match.score)}: ${verdict(match.score)}. `),
      '1 means the same shape; two shapes that have nothing to do with each other have about 0.37. ',
      match.mirrored ? 'The other shape is shown as in a mirror, as it fits better so.' : '',
    ),
    make('h2', {}, 'The whole shapes'),
    make(
      'p',
      { class: 'note' },
      'These measures make the score. Each adds to it (+) where the two differ less than most ' +
        'shapes do, and takes from it (−) where they differ more.',
    ),
    table(
      'Measures of the whole shapes',
      measuresOf(match).map((reason) => row(reason, [])),
    ),
    make('h2', {}, 'Part by part'),
    parts.length === 0
      ? make('p', { class: 'note' }, 'One of the two has no parts: no inside was found in it.')
      : make(
          'p',
          { class: 'note' },
          'When one is laid onto the other: parts that cover each other (+) have one colour; ' +
            'parts that lie apart or have no counterpart (−) speak against the likeness.',
        ),
    table(
      'Parts',
      parts.slice(0, kMostParts).map((reason) => row(reason, [swatch(colorOf(reason.part))])),
    ),
    hidden > 0 ? make('p', { class: 'note' }, `… and ${hidden} more`) : '',
  );
}

const table = (caption: string, rows: HTMLElement[]) =>
  make(
    'table',
    { class: 'reasons', hidden: rows.length === 0 },
    make('caption', { class: 'unseen' }, caption),
    make('tbody', {}, ...rows),
  );

function row(reason: Reason, before: Node[]): HTMLElement {
  const fill = make('span', { class: reason.adds ? 'fill' : 'fill against' });
  fill.style.width = `${Math.round(100 * Math.max(0.02, reason.amount))}%`;
  return make(
    'tr',
    {},
    make(
      'td',
      { class: reason.adds ? 'sign' : 'sign against' },
      make('span', { 'aria-hidden': 'true' }, reason.adds ? '+' : '−'),
      make('span', { class: 'unseen' }, reason.adds ? 'adds' : 'takes away'),
    ),
    make('th', { scope: 'row' }, ...before, reason.text),
    make('td', { class: 'amount', 'aria-hidden': 'true' }, make('span', { class: 'bar' }, fill)),
    make('td', { class: 'value' }, reason.value),
  );
}

/** A canvas with a caption; `label` is what it shows. */
export function figure(
  canvas: HTMLCanvasElement,
  label: string,
  ...caption: (Node | string)[]
): HTMLElement {
  canvas.setAttribute('role', 'img');
  canvas.setAttribute('aria-label', label);
  return make('figure', {}, canvas, make('figcaption', {}, ...caption));
}

export const caption = (name: string, text: string): Node[] => [
  nameOf(name),
  make('span', { class: 'class' }, text),
];
