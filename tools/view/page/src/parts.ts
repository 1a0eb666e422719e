// Rules by name: a part of the scene is typed, or clicked on.
import { partAt, parts as askParts, type Vec3 } from './api';
import { complain } from './panel';

export type Mode = 'decrease' | 'increase';

export class Parts {
  private asked = 0; // questions for a part; the last one counts, since a large scene is read for each

  /// `rule` makes a rule for the parts that a name or pattern fits.
  constructor(private row: HTMLElement, private field: HTMLInputElement, private names: HTMLElement, finer: HTMLElement, coarser: HTMLElement, private rule: (node: string, mode: Mode) => void) {
    finer.onclick = () => this.give('decrease');
    coarser.onclick = () => this.give('increase');
  }

  async begin(): Promise<void> {
    const names = await askParts();
    this.names.replaceChildren(...names.map((value) => Object.assign(document.createElement('option'), { value })));
    this.row.hidden = names.length === 0;
  }

  /// Takes the name of the part at a point that was clicked; null: the background.
  async take(at: Vec3 | null): Promise<void> {
    if (!at) return complain('No part is there.');
    const mine = ++this.asked;
    const name = await partAt(at).catch((error) => { complain(error); return null; });
    if (mine !== this.asked) return;
    if (name === '') complain('The part there has no name.');
    if (name) this.field.value = name;
  }

  private give(mode: Mode): void {
    const node = this.field.value.trim();
    if (node) this.rule(node, mode);
  }
}
