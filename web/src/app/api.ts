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

async function call(path: string, init?: RequestInit): Promise<Response> {
  let response: Response;
  try {
    response = await fetch(path, init);
  } catch (error) {
    if (init?.signal?.aborted) throw error;
    throw new ApiError(0, 'The server does not answer. Is morsel serve still running?');
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

export const getMatrix = (choice: Choice): Promise<Matrix> => getJson('matrix', chosen(choice));

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
      fail(new ApiError(0, 'The server does not answer. Is morsel serve still running?'));
    };
  });
}
