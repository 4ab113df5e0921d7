// The view of a shape's parts: a picture beside a panel. A page may hold several.
import type { Shape } from '../shape/format';
import { Model } from '../shape/model';
import { counted, percent, safeName } from '../shape/text';
import { Stage } from '../view/stage';
import { make, setText, uniqueId } from './dom';
import { Panel } from './panel';
import { State } from './state';
import { prefersDark, type Theme } from './theme';

const kTurn = Math.PI / 24; // of one key
const kZoom = 1.15;

export class PartView {
  private readonly state: State;
  private readonly stage: Stage | null;
  private readonly panel: Panel;
  private readonly canvas = make('canvas', { class: 'picture', tabindex: 0, role: 'application' });
  private readonly thin = make('p', { class: 'thin', hidden: true });
  private readonly tip = make('div', { class: 'tip', 'aria-hidden': 'true', hidden: true });
  private readonly news = make('p', { class: 'unseen', 'aria-live': 'polite' });
  private readonly end = new AbortController();
  private readonly sizes = new ResizeObserver(() => this.stage?.resize());

  constructor(
    private readonly host: HTMLElement,
    private readonly shape: Shape,
    private readonly theme: Theme,
  ) {
    const model = new Model(shape);
    this.state = new State(model);
    const overlay = make('canvas', { class: 'overlay', 'aria-hidden': 'true' });
    this.panel = new Panel(this.state, {
      change: (news) => this.refresh(news),
      resetCamera: () => this.stage?.resetCamera(),
      savePicture: () => void this.savePicture(),
      theme,
    });
    const help = uniqueId('keys');
    this.canvas.setAttribute('aria-describedby', help);
    const { canvas, tip, thin, panel } = this;
    const stage = make('div', { class: 'stage' }, canvas, overlay, tip, thin, panel.tools);
    this.host.append(
      make(
        'section',
        { class: 'part-view', 'aria-label': `Parts of ${shape.name}` },
        stage,
        this.panel.card.element,
        this.panel.element,
        this.news,
        make('p', { class: 'unseen', id: help }, kKeys),
      ),
    );
    this.stage = this.startStage(overlay, model, stage);
    if (this.stage) this.stage.onThin = (every) => this.sayThin(every);
    this.sizes.observe(stage);
    this.stage?.resize();
    this.listen();
    this.refresh();
  }

  dispose(): void {
    this.end.abort();
    this.sizes.disconnect();
    this.stage?.dispose();
    this.host.replaceChildren();
  }

  // Without WebGL the measures are there all the same.
  private startStage(overlay: HTMLCanvasElement, model: Model, stage: HTMLElement): Stage | null {
    try {
      return new Stage(this.canvas, overlay, model);
    } catch {
      const sorry = 'This browser shows no 3D (WebGL 2 is off). The measures beside are complete.';
      stage.replaceChildren(make('p', { class: 'sorry', role: 'alert' }, sorry));
      return null;
    }
  }

  private sayThin(every: number): void {
    this.thin.hidden = every === 1;
    if (every > 1) setText(this.thin, `One of ${every} points is drawn while it moves.`);
  }

  /** Draws and writes everything anew; `news` is read out. */
  private refresh(news?: string): void {
    const { state } = this;
    this.stage?.update(state.look(this.theme.dark));
    this.panel.refresh();
    const count = counted(state.view.parts.length, 'part');
    this.canvas.setAttribute('aria-label', `3D picture of ${this.shape.name}: ${count}`);
    if (news) setText(this.news, news);
  }

  // ---- pointer and keys -------------------------------------------------------------------------

  private listen(): void {
    const { signal } = this.end;
    const { canvas } = this;
    let pressed: PointerEvent | null = null;
    canvas.addEventListener('pointerdown', (event) => (pressed = event), { signal });
    canvas.addEventListener('pointermove', (event) => this.hover(event, pressed !== null), {
      signal,
    });
    canvas.addEventListener('pointerleave', () => this.setHovered(null), { signal });
    canvas.addEventListener('pointercancel', () => (pressed = null), { signal });
    canvas.addEventListener(
      'pointerup',
      (event) => {
        const moved = pressed
          ? Math.hypot(event.offsetX - pressed.offsetX, event.offsetY - pressed.offsetY)
          : Infinity;
        pressed = null;
        if (moved < 6 && event.button === 0) this.click(event);
      },
      { signal },
    );
    canvas.addEventListener('keydown', (event) => this.key(event), { signal });
    this.theme.onChange(() => this.refresh(), signal);
    prefersDark.addEventListener('change', () => this.refresh(), { signal });
  }

  private hover(event: PointerEvent, pressed: boolean): void {
    if (event.pointerType === 'touch' || pressed) return this.setHovered(null);
    const part = this.stage?.partAt(event.offsetX, event.offsetY) ?? null;
    this.setHovered(part);
    if (part === null) return;
    const { view } = this.state;
    const share = percent(view.parts[part].volume / view.volume);
    setText(this.tip, `Part ${part}: ${share} of the volume`);
    const right = event.offsetX > this.canvas.clientWidth - 200;
    this.tip.style.transform =
      `translate(${event.offsetX + (right ? -14 : 14)}px, ${event.offsetY + 14}px)` +
      (right ? ' translateX(-100%)' : '');
  }

  private setHovered(part: number | null): void {
    this.tip.hidden = part === null;
    this.canvas.style.cursor = part === null ? '' : 'pointer';
    if (part === this.state.hovered) return;
    this.state.hovered = part;
    this.refresh();
  }

  private click(event: PointerEvent): void {
    const part = this.stage?.partAt(event.offsetX, event.offsetY) ?? null;
    this.panel.select(part === this.state.selected ? null : part);
  }

  private key(event: KeyboardEvent): void {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const action = this.actionOf(event.key);
    if (!action) return;
    event.preventDefault();
    action();
  }

  private actionOf(key: string): (() => unknown) | undefined {
    const { stage, state, panel } = this;
    const selected = state.selected;
    const actions: Record<string, () => unknown> = {
      ArrowLeft: () => stage?.turn(-kTurn, 0),
      ArrowRight: () => stage?.turn(kTurn, 0),
      ArrowUp: () => stage?.turn(0, kTurn),
      ArrowDown: () => stage?.turn(0, -kTurn),
      '+': () => stage?.zoom(kZoom),
      '=': () => stage?.zoom(kZoom),
      '-': () => stage?.zoom(1 / kZoom),
      '0': () => stage?.resetCamera(),
      '[': () => panel.setLevel(state.view.level - 1),
      ']': () => panel.setLevel(state.view.level + 1),
      n: () => panel.selectNext(1),
      p: () => panel.selectNext(-1),
      h: () => selected !== null && panel.toggle(selected),
      o: () => selected !== null && panel.isolate(selected),
      a: () => panel.showAll(),
      Escape: () => panel.select(null),
    };
    return Object.hasOwn(actions, key) ? actions[key] : undefined;
  }

  // ---- pictures ---------------------------------------------------------------------------------

  private async savePicture(): Promise<void> {
    if (!this.stage) return;
    const url = URL.createObjectURL(await this.stage.picture());
    const name = `${safeName(this.shape.name)}-${this.state.view.parts.length}-parts.png`;
    make('a', { href: url, download: name }).click();
    setTimeout(() => URL.revokeObjectURL(url), 10_000);
    this.refresh(`Saved ${name}`);
  }
}

const kKeys =
  'Arrow keys turn the shape, plus and minus zoom, 0 goes back to the first view. Square brackets ' +
  'cut coarser and finer. n and p go through the parts, h hides one, o shows only it, a shows all.';
