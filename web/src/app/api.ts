// What the server says; docs/openapi.json describes it.
import { parseShape, pictureOf, type Picture, type Shape } from '../shape/format';

export interface ShapeInfo {
  name: string;
  class: string;
  tags: string[];
}

export interface DatabaseInfo {
  morsel: string;
  name: string;
  shapes: number;
  classes: { name: string; shapes: number }[];
  limits: { upload_bytes: number; upload_points: number; matrix_shapes: number };
}

export interface Hit extends ShapeInfo {
  rank: number;
  score: number;
}

export interface Match extends ShapeInfo {
  query: string;
  score: number;
  mirrored: boolean;
  matched: { target: number; source: number; contribution: number }[];
  unmatched_target: number[];
  unmatched_source: number[];
  terms: { name: string; distance: number; weight: number }[];
  /** Share of the volume of each part of the query and of the other shape. */
  target_shares: number[];
  source_shares: number[];
  picture: Picture;
}

export interface Matrix {
  shapes: ShapeInfo[];
  /** Row i has the scores with 0 … i. */
  scores: number[][];
}

export interface Upload {
  id: string;
  name: string;
  stage: 'waiting' | 'working' | 'done' | 'failed' | 'cancelled';
  step: string;
  fraction: number;
  message: string;
}

/** A stored shape by its name, or an upload by its id. */
export type Query = { name: string } | { upload: string };

export class ApiError extends Error {
  constructor(
    readonly status: number,
    message: string,
  ) {
    super(message);
  }
}

const kSilent = 'The server does not answer. Is morsel serve still running?';

async function call(path: string, init?: RequestInit): Promise<Response> {
  let response: Response;
  try {
    response = await fetch(path, init);
  } catch (error) {
    if (init?.signal?.aborted) throw error;
    throw new ApiError(0, kSilent);
  }
  if (response.ok) return response;
  const said = await response.json().catch(() => null);
  throw new ApiError(response.status, said?.error ?? `The server answered ${response.status}.`);
}

const address = (path: string, parameters: Record<string, string | number>) =>
  `/api/${path}?${new URLSearchParams(
    Object.entries(parameters).map(([key, value]) => [key, String(value)]),
  )}`;

const getJson = async (path: string, parameters: Record<string, string | number> = {}) =>
  (await call(address(path, parameters))).json();

export const getDatabase = (): Promise<DatabaseInfo> => getJson('database');

export interface Choice {
  text: string;
  /** Null: all. */
  class: string | null;
}

const chosen = ({ text, class: of }: Choice) => ({
  ...(text ? { text } : {}),
  ...(of === null ? {} : { class: of }),
});

export const getShapes = (
  choice: Choice,
  offset: number,
  limit: number,
): Promise<{ total: number; shapes: ShapeInfo[] }> =>
  getJson('shapes', { ...chosen(choice), offset, limit });

/** Calls `report` with the share that is done until the table is there. */
export async function getMatrix(
  choice: Choice,
  report: (fraction: number) => void,
  signal: AbortSignal,
): Promise<Matrix> {
  const response = await call(address('matrix/events', chosen(choice)), { signal });
  for await (const said of eventsOf(response.body!)) {
    if ('error' in said) throw new ApiError(500, said.error);
    if ('scores' in said) return said;
    report(said.fraction);
  }
  throw new ApiError(0, kSilent);
}

type MatrixEvent = { fraction: number } | { error: string } | Matrix;

/** The events of a stream, of one line each. */
async function* eventsOf(stream: ReadableStream<Uint8Array>): AsyncGenerator<MatrixEvent> {
  const reader = stream.getReader();
  const decoder = new TextDecoder();
  let begun: string[] = []; // of a line; it may come in thousands of pieces
  for (let piece = await reader.read(); !piece.done; piece = await reader.read()) {
    const [end, ...lines] = decoder.decode(piece.value, { stream: true }).split('\n');
    begun.push(end);
    for (const next of lines) {
      const line = begun.join('');
      begun = [next];
      if (line.startsWith('data: ')) yield JSON.parse(line.slice('data: '.length));
    }
  }
}

export const search = (query: Query, top: number): Promise<{ query: string; hits: Hit[] }> =>
  getJson('search', { ...query, top });

export const getPicture = async (query: Query): Promise<Picture> =>
  pictureOf(await getJson('picture', { ...query }));

export async function getMatch(query: Query, other: string): Promise<Match> {
  const json = await getJson('match', { ...query, with: other });
  return { ...json, picture: pictureOf(json.picture) };
}

export const getParts = async (query: Query): Promise<Shape> =>
  parseShape(await (await call(address('parts', { ...query }))).text());

export const thumbnail = (name: string) => address('thumbnail', { name });

export async function logIn(token: string): Promise<void> {
  const headers = { 'Content-Type': 'application/json' };
  await call('/api/session', { method: 'POST', headers, body: JSON.stringify({ token }) });
}

export async function sendFile(file: File): Promise<Upload> {
  const headers = { 'Content-Type': 'application/octet-stream' };
  const path = address('uploads', { name: file.name });
  return (await call(path, { method: 'POST', headers, body: file })).json();
}

export const cancelUpload = (id: string) => call(address('upload', { id }), { method: 'DELETE' });

/** Calls `report` with every state until the last one, which is returned. */
export async function follow(
  id: string,
  report: (state: Upload) => void,
  signal: AbortSignal,
): Promise<Upload> {
  await getJson('upload', { id }); // says what is wrong, as events cannot
  return new Promise((done, fail) => {
    const events = new EventSource(address('upload/events', { id }));
    signal.addEventListener('abort', () => {
      events.close();
      fail(signal.reason);
    });
    let failures = 0;
    events.onmessage = ({ data }) => {
      failures = 0;
      const state: Upload = JSON.parse(data);
      report(state);
      if (state.stage === 'waiting' || state.stage === 'working') return;
      events.close();
      done(state);
    };
    events.onerror = () => {
      // It tries again by itself, every few seconds.
      if (events.readyState !== EventSource.CLOSED && ++failures < 4) return;
      events.close();
      fail(new ApiError(0, kSilent));
    };
  });
}
