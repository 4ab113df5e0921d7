// Numbers and names as people read them.

/** "41%", "4.1%", "0.41%", "< 0.01%". */
export function percent(share: number): string {
  const value = 100 * share;
  if (!(value > 0)) return '0%';
  if (value < 0.01) return '< 0.01%';
  return `${value.toFixed(value < 0.995 ? 2 : value < 9.95 ? 1 : 0)}%`;
}

/** Three significant digits, without an exponent where that stays short. */
export function length(value: number): string {
  if (value !== 0 && (Math.abs(value) >= 1e6 || Math.abs(value) < 1e-4)) {
    return value.toExponential(2);
  }
  return String(Number(value.toPrecision(3)));
}

/** Of a part, from the radius of its largest ball; databases keep it of the largest parts only. */
export const thickness = (ballRadius: number) => (ballRadius > 0 ? length(2 * ballRadius) : '–');

/** "1 part", "12,345 points". */
export function counted(count: number, noun: string): string {
  return `${count.toLocaleString('en')} ${noun}${count === 1 ? '' : 's'}`;
}

/** The name of a file that may go anywhere: letters, digits, dots and dashes. */
export function safeName(name: string): string {
  const safe = name
    .replace(/\.[^.]*$/, '')
    .replace(/[^\w.-]+/g, '_')
    .replace(/^[._]+|_+$/g, '');
  return safe.slice(0, 80) || 'shape';
}
