// The pages of the app, as they stand behind # in the address.
import type { Query } from './api';

export type Page =
  | { page: 'shapes'; text: string; class: string | null }
  | { page: 'like'; query: Query }
  | { page: 'compare'; query: Query; other: string }
  | { page: 'parts'; query: Query }
  | { page: 'pairs' };

const hash = (page: string, parameters: Record<string, string>) => {
  const search = new URLSearchParams(parameters).toString();
  return `#/${page}${search ? `?${search}` : ''}`;
};

export const likeLink = (query: Query) => hash('like', { ...query });
export const partsLink = (query: Query) => hash('parts', { ...query });
export const compareLink = (query: Query, other: string) =>
  hash('compare', { ...query, with: other });
export const shapesLink = (text: string, of: string | null) =>
  hash('', { ...(text ? { text } : {}), ...(of === null ? {} : { class: of }) });
export const pairsLink = '#/pairs';

/** What an address asks for; the gallery when it is none of ours. */
export function pageOf(fragment: string): Page {
  const [path, search = ''] = fragment.replace(/^#\/?/, '').split(/\?(.*)/s);
  const parameters = new URLSearchParams(search);
  const name = parameters.get('name');
  const upload = parameters.get('upload');
  const other = parameters.get('with');
  const query: Query | null = upload ? { upload } : name ? { name } : null;
  if (path === 'pairs') return { page: 'pairs' };
  if (query && path === 'like') return { page: 'like', query };
  if (query && path === 'parts') return { page: 'parts', query };
  if (query && path === 'compare' && other) return { page: 'compare', query, other };
  return { page: 'shapes', text: parameters.get('text') ?? '', class: parameters.get('class') };
}
