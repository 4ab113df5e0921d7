// A file of the visitor's: sent, segmented, then looked up.
import { make, setText } from '../ui/dom';
import { percent } from '../shape/text';
import { cancelUpload, follow, getDatabase, sendFile, type Upload } from './api';
import { likeLink } from './links';
import { heading, notice, waiting } from './parts_of_page';
import { stepText } from './words';

/** Sends the file and goes to its page. */
export async function upload(file: File, host: HTMLElement, signal: AbortSignal): Promise<void> {
  host.replaceChildren(heading(file.name), waiting('Sending the file …'));
  const { limits } = await getDatabase();
  if (file.size > limits.upload_bytes) {
    const most = Math.floor(limits.upload_bytes / 2 ** 20);
    host.append(
      notice(`This file has ${Math.ceil(file.size / 2 ** 20)} MB; at most ${most} MB are taken.`),
    );
    host.querySelector('[role=status]')!.remove();
    return;
  }
  const { id } = await sendFile(file);
  if (!signal.aborted) location.hash = likeLink({ upload: id });
}

/** Shows how far it is; true when it is done and can be compared. */
export async function awaitUpload(
  host: HTMLElement,
  id: string,
  signal: AbortSignal,
): Promise<boolean> {
  const title = heading('Your file');
  const bar = make('progress', { max: 1, value: 0, 'aria-label': 'Progress' });
  const step = make('p', { role: 'status' });
  const stop = make('button', { type: 'button', click: () => void cancelUpload(id) }, 'Cancel');
  const box = make('div', { class: 'working' }, title, bar, step, stop);
  const show = (state: Upload) => {
    setText(title, state.name);
    bar.value = state.fraction;
    setText(step, `${stepText(state.step)} … ${percent(state.fraction)}`);
    if (!box.isConnected) host.append(box);
  };
  const state = await follow(id, show, signal);
  if (state.stage === 'done') {
    box.remove();
    return true;
  }
  bar.remove();
  stop.remove();
  step.replaceWith(
    state.stage === 'cancelled'
      ? make('p', { class: 'notice', role: 'status' }, 'You cancelled this file.')
      : notice(state.message),
  );
  return false;
}
