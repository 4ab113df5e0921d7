// What several pages are made of.
import { make } from '../ui/dom';
import { scoreText, splitName, verdict } from './words';

/** The name of a shape, its folder set back. */
export function nameOf(name: string): HTMLElement {
  const [folder, last] = splitName(name);
  return make(
    'span',
    { class: 'name' },
    ...(folder ? [make('span', { class: 'folder' }, folder)] : []),
    last,
  );
}

/** A heading that takes the focus when its page opens. */
export const heading = (...children: (Node | string)[]) =>
  make('h1', { tabindex: -1 }, ...children);

export const notice = (text: string) => make('p', { class: 'notice', role: 'alert' }, text);

export const waiting = (text: string) => make('p', { class: 'notice', role: 'status' }, text);

/** A score as a bar, a number and words. */
export function scoreBar(score: number): HTMLElement {
  const bar = make('span', { class: 'fill' });
  bar.style.width = `${Math.round(100 * score)}%`;
  return make(
    'span',
    { class: 'score' },
    make('span', { class: 'bar', 'aria-hidden': 'true' }, bar),
    make('b', {}, scoreText(score)),
    make('span', {}, verdict(score)),
  );
}

/** A choice of one of several. */
export function select(
  label: string,
  options: readonly (readonly [value: string, text: string])[],
  chosen: string,
  change: (value: string) => void,
): HTMLElement {
  const box = make(
    'select',
    {},
    ...options.map(([value, text]) => make('option', { value, selected: value === chosen }, text)),
  );
  box.addEventListener('change', () => change(box.value));
  return make('label', { class: 'field' }, make('span', {}, label), box);
}

/** What the user types, told when they pause. */
export function filterBox(
  label: string,
  text: string,
  change: (text: string) => void,
): HTMLElement {
  const box = make('input', { type: 'search', value: text, maxlength: 200 });
  let pause = 0;
  box.addEventListener('input', () => {
    clearTimeout(pause);
    pause = window.setTimeout(() => change(box.value.trim()), 200);
  });
  return make('label', { class: 'field' }, make('span', {}, label), box);
}
