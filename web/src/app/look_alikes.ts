// The shapes that look most like one, all in its pose, and why.
import { make } from '../ui/dom';
import { counted } from '../shape/text';
import type { Picture } from '../shape/format';
import type { Theme } from '../ui/theme';
import { Pictures } from '../view/pictures';
import { getDatabase, getMatch, getPicture, search, type Hit, type Query } from './api';
import { picture as thumbnailOf } from './gallery';
import { compareLink, likeLink, partsLink } from './links';
import { heading, nameOf, notice, scoreBar } from './parts_of_page';
import { caption, explain, figure } from './why';

const kHits = 12;
const kTurn = Math.PI / 24; // of one key

/** Pictures in one pose that turn by pointer and keys, or null without WebGL. */
class Group {
  private readonly pictures: Pictures | null;
  readonly parts: number;

  constructor(
    readonly query: Picture,
    theme: Theme,
    signal: AbortSignal,
  ) {
    this.parts = 1 + query.points.pieces.reduce((most, piece) => Math.max(most, piece), 0);
    this.pictures = startPictures(query, theme);
    signal.addEventListener('abort', () => this.pictures?.dispose());
    theme.onChange(() => this.pictures?.requestFrame(), signal);
  }

  add(canvas: HTMLCanvasElement, picture: Picture): boolean {
    // The last index of the query's points may be that of points without a part; grey either way.
    this.pictures?.add(canvas, picture, this.parts);
    return this.pictures !== null;
  }

  key(event: KeyboardEvent): void {
    const actions: Record<string, () => void> = {
      ArrowLeft: () => this.pictures?.turn(-kTurn, 0),
      ArrowRight: () => this.pictures?.turn(kTurn, 0),
      ArrowUp: () => this.pictures?.turn(0, -kTurn),
      ArrowDown: () => this.pictures?.turn(0, kTurn),
      '0': () => this.pictures?.resetPose(),
    };
    if (!Object.hasOwn(actions, event.key) || event.ctrlKey || event.altKey || event.metaKey)
      return;
    event.preventDefault();
    actions[event.key]();
  }
}

function startPictures(query: Picture, theme: Theme): Pictures | null {
  try {
    return new Pictures(query.view, () => theme.dark);
  } catch {
    return null;
  }
}

const kKeys = 'Drag a picture to turn all of them; with the keyboard: arrow keys, 0 turns back.';

/** The query's own picture, which also takes the keys. */
function queryFigure(group: Group, name: string, text: string): HTMLElement {
  const canvas = make('canvas', {
    class: 'small-picture',
    tabindex: 0,
    keydown: (event) => group.key(event as KeyboardEvent),
  });
  if (!group.add(canvas, group.query)) {
    return make('p', { class: 'notice' }, 'This browser shows no 3D (WebGL 2 is off).');
  }
  return figure(canvas, `${name}, its parts in colours. ${kKeys}`, ...caption(name, text));
}

export async function showLookAlikes(
  host: HTMLElement,
  query: Query,
  theme: Theme,
  signal: AbortSignal,
): Promise<void> {
  const [database, found, picture] = await Promise.all([
    getDatabase(),
    search(query, kHits + 1),
    getPicture(query),
  ]);
  signal.throwIfAborted();
  const stored = 'name' in query;
  const hits = found.hits.filter((hit) => !stored || hit.name !== query.name).slice(0, kHits);
  const group = new Group(picture, theme, signal);
  const others = database.shapes - (stored ? 1 : 0);
  host.append(
    heading('Look-alikes of ', nameOf(found.query)),
    make(
      'p',
      { class: 'lead' },
      hits.length === 0
        ? 'There is no other shape in the database to compare it with.'
        : `The ${hits.length === 1 ? 'one' : hits.length} most alike of ${counted(others, 'shape')}, ` +
            'each turned to lie as this one does. One colour marks parts that lie on each other; ' +
            'what is grey has no counterpart. Drag any picture to turn them all.',
    ),
    make(
      'div',
      { class: 'like' },
      make(
        'div',
        { class: 'query' },
        queryFigure(group, found.query, stored ? 'this shape' : 'your file'),
        make('a', { class: 'button', href: partsLink(query) }, 'Look at its parts'),
      ),
      make(
        'section',
        {},
        make('h2', { class: 'unseen' }, 'The most alike'),
        make('ol', { class: 'hits' }, ...hits.map((hit) => hitCard(hit, query, group, signal))),
      ),
    ),
  );
}

function hitCard(hit: Hit, query: Query, group: Group, signal: AbortSignal): HTMLElement {
  const place = make('div', { class: 'small-picture' });
  const card = make(
    'li',
    {},
    place,
    make('a', { href: likeLink({ name: hit.name }) }, nameOf(hit.name)),
    make('span', { class: 'class' }, hit.class || ' '),
    scoreBar(hit.score),
    make(
      'a',
      {
        class: 'button',
        href: compareLink(query, hit.name),
        'aria-label': `Why? Compare with ${hit.name}`,
      },
      'Why?',
    ),
  );
  void drawHit(hit, query, group, place, signal);
  return card;
}

async function drawHit(
  hit: Hit,
  query: Query,
  group: Group,
  place: HTMLElement,
  signal: AbortSignal,
): Promise<void> {
  try {
    const match = await getMatch(query, hit.name);
    if (signal.aborted) return;
    const canvas = make('canvas', { class: 'small-picture', role: 'img' });
    canvas.setAttribute('aria-label', `${hit.name}, turned as the first`);
    const label = match.mirrored ? [make('span', { class: 'badge' }, 'mirrored')] : [];
    place.replaceChildren(canvas, ...label);
    if (!group.add(canvas, match.picture)) place.replaceChildren(thumbnailOf(hit.name));
  } catch (error) {
    if (!signal.aborted) place.replaceChildren(notice(String((error as Error).message)));
  }
}

/** Two shapes beside each other, and why they score as they do. */
export async function showComparison(
  host: HTMLElement,
  query: Query,
  other: string,
  theme: Theme,
  signal: AbortSignal,
): Promise<void> {
  const [match, picture] = await Promise.all([getMatch(query, other), getPicture(query)]);
  signal.throwIfAborted();
  const group = new Group(picture, theme, signal);
  const canvas = make('canvas', { class: 'small-picture' });
  const drawn = group.add(canvas, match.picture);
  host.append(
    heading('Why ', nameOf(match.query), ' and ', nameOf(other), ' score ', match.score.toFixed(2)),
    make(
      'p',
      {},
      make('a', { href: likeLink(query) }, `All look-alikes of ${match.query}`),
      ' · ',
      make('a', { href: likeLink({ name: other }) }, `Look-alikes of ${other}`),
    ),
    make(
      'div',
      { class: 'pair' },
      queryFigure(group, match.query, 'here'),
      drawn
        ? figure(canvas, `${other}, turned as the first`, ...caption(other, 'there, turned to fit'))
        : thumbnailOf(other),
    ),
    make('p', { class: 'note' }, kKeys),
    explain(match, picture),
  );
}
