// Elements in one line each. Text becomes text, never markup.

type Attributes = Record<string, string | number | boolean | ((event: Event) => void) | undefined>;

/** Makes an element; attributes that are functions listen to the event of their name. */
export function make<Name extends keyof HTMLElementTagNameMap>(
  name: Name,
  attributes: Attributes = {},
  ...children: (Node | string)[]
): HTMLElementTagNameMap[Name] {
  const element = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) {
    if (typeof value === 'function') element.addEventListener(key, value);
    else if (value === true) element.setAttribute(key, '');
    else if (value !== false && value !== undefined) element.setAttribute(key, String(value));
  }
  element.append(...children);
  return element;
}

/** Sets the text where it has changed, so that screen readers are not bothered twice. */
export function setText(element: HTMLElement, text: string): void {
  if (element.textContent !== text) element.textContent = text;
}

let serial = 0;

/** An id that no other element of the page has. */
export const uniqueId = (name: string) => `morsel-${name}-${++serial}`;
