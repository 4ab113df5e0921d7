// Light or dark: as the system says, until the user says otherwise.

export const prefersDark = matchMedia('(prefers-color-scheme: dark)');

export class Theme {
  private chosen: boolean | null = null;
  private readonly changed = new EventTarget();

  get dark(): boolean {
    return this.chosen ?? prefersDark.matches;
  }

  toggle(): void {
    this.chosen = !this.dark;
    document.documentElement.dataset.theme = this.chosen ? 'dark' : 'light';
    this.changed.dispatchEvent(new Event('change'));
  }

  onChange(listen: () => void, signal: AbortSignal): void {
    this.changed.addEventListener('change', listen, { signal });
  }
}
