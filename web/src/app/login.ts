// The token, when the server wants one: from the address behind #token=, or asked for.
import { make } from '../ui/dom';
import { logIn } from './api';
import { heading, notice } from './parts_of_page';

/** Takes a token out of the address, so that it is in no history, and hands it in. */
export async function takeToken(): Promise<void> {
  const given = /^#token=(.+)$/.exec(location.hash);
  if (!given) return;
  history.replaceState(null, '', location.pathname);
  await logIn(decodeURIComponent(given[1])).catch(() => undefined); // the form asks again
}

export function askForToken(host: HTMLElement, done: () => void): void {
  const box = make('input', {
    type: 'password',
    name: 'token',
    autocomplete: 'current-password',
    required: true,
  });
  const failure = make('div');
  const submit = async (event: Event) => {
    event.preventDefault();
    try {
      await logIn(box.value.trim());
      done();
    } catch (error) {
      failure.replaceChildren(notice((error as Error).message));
    }
  };
  host.replaceChildren(
    heading('This server wants a token'),
    make('p', { class: 'lead' }, 'It was chosen by whoever started morsel serve.'),
    make(
      'form',
      { class: 'filters', submit: (event) => void submit(event) },
      // For the browsers' stores of passwords.
      make('input', { name: 'user', autocomplete: 'username', value: 'morsel', hidden: true }),
      make('label', { class: 'field' }, make('span', {}, 'Token'), box),
      make('button', {}, 'Enter'),
    ),
    failure,
  );
  box.focus();
}
