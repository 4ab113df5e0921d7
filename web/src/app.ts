// The web app of `morsel serve`: a page for each address behind #.
import './page.css';
import './app/app.css';
import { ApiError, getParts, type Query } from './app/api';
import { showGallery } from './app/gallery';
import { pageOf, pairsLink, type Page } from './app/links';
import { askForToken, takeToken } from './app/login';
import { showComparison, showLookAlikes } from './app/look_alikes';
import { showPairs } from './app/pairs';
import { notice, waiting } from './app/parts_of_page';
import { awaitUpload, upload } from './app/upload';
import { make, setText } from './ui/dom';
import { PartView } from './ui/part_view';
import { Theme } from './ui/theme';

const theme = new Theme();
const main = make('main');
const fileInput = make('input', {
  type: 'file',
  class: 'unseen',
  tabindex: -1,
  'aria-hidden': 'true',
});
const chooseFile = () => fileInput.click();
let leave = new AbortController(); // of the page that is shown

function header(): HTMLElement {
  const toggle = make('button', { type: 'button', click: () => theme.toggle() });
  const name = () => setText(toggle, theme.dark ? 'Light' : 'Dark');
  theme.onChange(name, new AbortController().signal);
  name();
  return make(
    'header',
    { class: 'top' },
    make(
      'nav',
      { 'aria-label': 'Pages' },
      make('a', { class: 'brand', href: '#/' }, 'morsel'),
      make('a', { href: '#/', 'data-page': 'shapes' }, 'Shapes'),
      make('a', { href: pairsLink, 'data-page': 'pairs' }, 'All pairs'),
    ),
    make('button', { type: 'button', class: 'strong', click: chooseFile }, 'Look up a file …'),
    toggle,
    fileInput,
  );
}

/** Shows a page in place of the one before; what goes wrong is said on it. */
async function show(
  work: (host: HTMLElement, signal: AbortSignal) => Promise<void>,
): Promise<void> {
  leave.abort();
  leave = new AbortController();
  const { signal } = leave;
  const host = make('div', { class: 'page' });
  main.replaceChildren(host);
  const slow = setTimeout(() => host.prepend(waiting('Loading …')), 400);
  try {
    await work(host, signal);
    host.querySelector<HTMLElement>('h1[tabindex]')?.focus({ preventScroll: true });
    document.title = `${host.querySelector('h1')?.textContent ?? 'Shapes'} – morsel`;
  } catch (error) {
    if (signal.aborted) return;
    if (error instanceof ApiError && error.status === 401) {
      askForToken(host, route);
      return;
    }
    if (!(error instanceof ApiError)) console.error(error);
    host.replaceChildren(
      make('h1', {}, 'That did not work'),
      notice(error instanceof Error ? error.message : String(error)),
      make('p', {}, make('a', { class: 'button', href: '#/' }, 'Back to the shapes')),
    );
  } finally {
    clearTimeout(slow);
    if (!signal.aborted) host.querySelector(':scope > .notice[role=status]:first-child')?.remove();
  }
}

async function showParts(host: HTMLElement, query: Query, signal: AbortSignal): Promise<void> {
  const shape = await getParts(query);
  signal.throwIfAborted();
  host.classList.add('whole');
  const view = new PartView(host, shape, theme);
  signal.addEventListener('abort', () => view.dispose());
}

async function open(page: Page, host: HTMLElement, signal: AbortSignal): Promise<void> {
  if ('query' in page && 'upload' in page.query) {
    if (!(await awaitUpload(host, page.query.upload, signal))) return;
  }
  switch (page.page) {
    case 'shapes':
      return showGallery(host, page, chooseFile, signal);
    case 'like':
      return showLookAlikes(host, page.query, theme, signal);
    case 'compare':
      return showComparison(host, page.query, page.other, theme, signal);
    case 'parts':
      return showParts(host, page.query, signal);
    case 'pairs':
      return showPairs(host, theme, signal);
  }
}

function route(): void {
  const page = pageOf(location.hash);
  for (const link of document.querySelectorAll<HTMLElement>('nav [data-page]')) {
    if (link.dataset.page === page.page) link.setAttribute('aria-current', 'page');
    else link.removeAttribute('aria-current');
  }
  scrollTo(0, 0);
  void show((host, signal) => open(page, host, signal));
}

function lookUp(file: File | undefined): void {
  if (file) void show((host, signal) => upload(file, host, signal));
}

function acceptDrops(): void {
  const over = (on: boolean) => document.body.classList.toggle('dropping', on);
  addEventListener('dragover', (event) => {
    if (!event.dataTransfer?.types.includes('Files')) return;
    event.preventDefault();
    over(true);
  });
  addEventListener('dragleave', (event) => {
    if (event.relatedTarget === null) over(false);
  });
  addEventListener('drop', (event) => {
    event.preventDefault();
    over(false);
    lookUp(event.dataTransfer?.files[0]);
  });
  fileInput.addEventListener('change', () => {
    lookUp(fileInput.files?.[0]);
    fileInput.value = '';
  });
}

await takeToken();
document.body.append(header(), main);
acceptDrops();
addEventListener('hashchange', route);
route();
