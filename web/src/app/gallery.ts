// All shapes of the database, to look for one by its name or class.
import { make, setText } from '../ui/dom';
import { counted } from '../shape/text';
import { getDatabase, getShapes, thumbnail, type Choice, type ShapeInfo } from './api';
import { likeLink, shapesLink } from './links';
import { filterBox, heading, nameOf, select } from './parts_of_page';

const kPage = 60;

export async function showGallery(
  host: HTMLElement,
  first: Choice,
  chooseFile: () => void,
  signal: AbortSignal,
): Promise<void> {
  const database = await getDatabase();
  signal.throwIfAborted();
  host.append(
    heading(`${counted(database.shapes, 'shape')} in ${database.name}`),
    make(
      'p',
      { class: 'lead' },
      'Choose a shape to see which others look like it. ',
      make('button', { type: 'button', class: 'link', click: chooseFile }, 'Look up a file'),
      ' of yours, or drop it anywhere here: a point cloud or a mesh.',
    ),
  );
  if (database.shapes === 0) {
    host.append(
      make('p', { class: 'notice' }, 'This database is empty. Fill it from a terminal:'),
      make('pre', {}, `morsel index --database ${database.name} FOLDER`),
    );
    return;
  }
  const choice = { ...first };
  const list = make('ul', { class: 'tiles' });
  const count = make('p', { class: 'note', role: 'status' });
  const more = make('button', { type: 'button', click: () => void add() }, 'Show more');
  let shown = 0;
  let turn = 0; // answers to earlier questions come to nothing
  const add = async () => {
    const mine = ++turn;
    const page = await getShapes(choice, shown, kPage);
    if (mine !== turn || signal.aborted) return;
    list.append(...page.shapes.map(tile));
    shown += page.shapes.length;
    more.hidden = shown >= page.total;
    setText(
      count,
      page.total === 0
        ? 'No shape has this in its name, class or tags.'
        : `${shown.toLocaleString('en')} of ${counted(page.total, 'shape')}`,
    );
  };
  const change = async () => {
    history.replaceState(null, '', shapesLink(choice.text, choice.class));
    list.replaceChildren();
    shown = 0;
    await add();
  };
  host.append(
    make(
      'form',
      { class: 'filters', role: 'search', submit: (event) => event.preventDefault() },
      filterBox('Name, class or tag has', choice.text, (text) => {
        choice.text = text;
        void change();
      }),
      ...classSelect(database.classes, choice, change),
    ),
    count,
    list,
    make('p', { class: 'more' }, more),
  );
  await add();
}

/** A choice of classes, if there are any. */
export function classSelect(
  classes: readonly { name: string; shapes: number }[],
  choice: Choice,
  change: () => void,
): HTMLElement[] {
  if (classes.length < 2) return [];
  const options: [string, string][] = [['*', 'all classes']];
  for (const { name, shapes } of classes) {
    options.push([`=${name}`, `${name || 'without a class'} (${shapes})`]);
  }
  const chosen = choice.class === null ? '*' : `=${choice.class}`;
  return [
    select('Class', options, chosen, (value) => {
      choice.class = value === '*' ? null : value.slice(1);
      change();
    }),
  ];
}

function tile(shape: ShapeInfo): HTMLElement {
  return make(
    'li',
    {},
    make(
      'a',
      { class: 'tile', href: likeLink({ name: shape.name }) },
      picture(shape.name),
      nameOf(shape.name),
      make('span', { class: 'class' }, shape.class || ' '),
    ),
  );
}

/** The small picture of a stored shape; its name stands beside it. */
export function picture(name: string): HTMLElement {
  return make('img', {
    src: thumbnail(name),
    alt: '',
    loading: 'lazy',
    width: 192,
    height: 192,
  });
}
