// What the user has chosen; the only thing in the viewer that changes.
import type { Model, View } from '../shape/model';
import type { Layers, Look } from '../view/stage';

export class State {
  view: View;
  hovered: number | null = null;
  spread = 0;
  layers: Layers = { form: 'surface', numbers: true, graph: false };
  private readonly hiddenPieces = new Set<number>();
  private selectedPiece: number | null = null;

  constructor(readonly model: Model) {
    this.view = model.view(model.firstLevel);
  }

  setLevel(level: number): void {
    this.view = this.model.view(Math.max(0, Math.min(this.model.levels.length - 1, level)));
    this.hovered = null;
  }

  /** The part that holds what was selected, at whatever level. */
  get selected(): number | null {
    return this.selectedPiece === null ? null : this.view.partOfPiece[this.selectedPiece];
  }

  select(part: number | null): void {
    this.selectedPiece = part === null ? null : this.view.leaders[part];
  }

  /** By part: all of it is hidden. */
  get hidden(): boolean[] {
    const hidden = this.view.parts.map(() => true);
    this.view.partOfPiece.forEach((part, piece) => {
      if (!this.hiddenPieces.has(piece)) hidden[part] = false;
    });
    return hidden;
  }

  /** Shows or hides parts as `wanted` says for each. */
  setHidden(wanted: (part: number) => boolean): void {
    this.view.partOfPiece.forEach((part, piece) => {
      if (wanted(part)) this.hiddenPieces.add(piece);
      else this.hiddenPieces.delete(piece);
    });
  }

  toggle(part: number): void {
    const { hidden } = this;
    hidden[part] = !hidden[part];
    this.setHidden((i) => hidden[i]);
  }

  /** Hides all others; shows all when the part is alone already. */
  isolate(part: number): void {
    const alone = this.hidden.every((hidden, i) => hidden === (i !== part));
    this.setHidden((i) => !alone && i !== part);
  }

  look(dark: boolean): Look {
    const { view, hidden, selected, hovered, spread, layers } = this;
    return { view, hidden, selected, hovered, spread, layers, dark };
  }
}
