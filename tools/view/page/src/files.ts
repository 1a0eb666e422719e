// Files that --show names, as layers beside the scene: a row in the panel and a mesh in the view each.
import { bytes, type LayerState } from './api';
import { complain } from './panel';
import type { View } from './view';
import { readMesh } from './wire';

const kColors = ['#d98c5f', '#7fa7d9', '#b98bd0', '#d3b85a', '#6fbfb0', '#d77a95', '#8fbf6a', '#c9c2b2', '#a0763f', '#5a7fd0', '#d05a5a', '#7d8c99'];

interface Row {
  item: HTMLLIElement; shown: HTMLInputElement; color: HTMLInputElement; opacity: HTMLInputElement; level: HTMLSelectElement;
  count: HTMLElement; badge: HTMLElement; prove: HTMLButtonElement; loaded: string | null;
  asked: boolean;  // a person waits for the answer of bpcheck
  inner: boolean;  // the file claims to lie inside the scene
}

function make<K extends keyof HTMLElementTagNameMap>(tag: K, more: Partial<HTMLElementTagNameMap[K]> = {}): HTMLElementTagNameMap[K] {
  return Object.assign(document.createElement(tag), more);
}

/// Returns the text and the look of a badge for the answer of bpcheck.
function badgeOf(layer: LayerState): [string, string] {
  if (layer.step === 'waiting' || layer.step === 'checking') return ['checking …', 'work'];
  if (layer.step === 'failed') return ['failed', 'refuted'];
  if (layer.step === 'none') return ['', ''];
  const answer = layer.verdict?.answer ?? 'no answer';
  return [answer, answer === 'proven' ? 'proven' : 'refuted'];
}

/// Returns whether bpcheck can be asked now; it can be asked again, since files change.
export function isProvable(layer: LayerState): boolean {
  return layer.kind !== 'voxels' && layer.step !== 'waiting' && layer.step !== 'checking';
}

function factsOf(layer: LayerState): string {
  const lines = [layer.claims ? `Claims that ${layer.claims}.` : layer.kind === 'mesh' ? 'Claims nothing; asked is whether it encloses the scene.' : ''];
  if (layer.not_claimed) lines.push(`Does not claim ${layer.not_claimed}.`);
  lines.push(...layer.made_by);
  if (layer.step === 'done') lines.push([layer.verdict?.answer, layer.verdict?.why].filter(Boolean).join(': '));
  if (layer.step === 'failed') lines.push(layer.notes);
  return lines.filter(Boolean).join('\n');
}

export class Files {
  private rows: Row[] = [];
  private distances = false;
  readonly told = { loaded: 0 };
  constructor(private list: HTMLElement, private proofs: HTMLElement, private view: View, private prove: (i: number) => void, private changed: () => void) {}

  tell(layers: LayerState[]): void {
    if (this.rows.length === 0 && layers.length > 0) {
      this.rows = layers.map((layer, i) => this.row(layer, i));
      this.list.replaceChildren(...this.rows.map((row) => row.item));
      this.list.closest('section')!.hidden = false;
      this.toggle(0);
    }
    layers.forEach((layer, i) => {
      const row = this.rows[i], [text, kind] = badgeOf(layer);
      row.badge.textContent = text;
      row.badge.className = `badge ${kind}`;
      row.badge.hidden = text === '';
      row.prove.hidden = !isProvable(layer);
      row.item.title = `${layer.name}\n${factsOf(layer)}`;
      const done = row.asked && (layer.step === 'done' || layer.step === 'failed');
      row.asked = !done && row.asked;
      row.item.querySelector('.why')!.textContent = layer.step === 'done' && layer.verdict?.answer !== 'proven' ? layer.verdict?.why ?? '' : layer.step === 'failed' ? layer.notes : '';
      if (done) row.item.scrollIntoView({ block: 'nearest' });
    });
    this.tellProofs(layers);
  }
  /// Counts the answers beside the heading: rows may lie outside the list.
  private tellProofs(layers: LayerState[]): void {
    const all = layers.filter((layer) => layer.kind !== 'voxels'), answered = all.filter((layer) => layer.step === 'done' || layer.step === 'failed');
    const proven = answered.filter((layer) => layer.verdict?.answer === 'proven').length, working = all.some((layer) => layer.step === 'waiting' || layer.step === 'checking');
    this.proofs.hidden = answered.length === 0 && !working;
    this.proofs.textContent = `${proven} of ${all.length} proven${working ? ' …' : ''}`;
    this.proofs.className = `badge ${working ? 'work' : proven < answered.length ? 'refuted' : proven === all.length ? 'proven' : ''}`;
  }

  private row(layer: LayerState, i: number): Row {
    const label = make('label', { className: 'name' }), head = make('div', { className: 'line' }), foot = make('div', { className: 'line' });
    const row: Row = {
      item: make('li'), shown: make('input', { type: 'checkbox' }), color: make('input', { type: 'color', value: kColors[i % kColors.length], title: 'Colour' }),
      opacity: make('input', { type: 'range', min: '5', max: '100', value: '40', step: '5', title: 'Opacity beside other layers' }), level: make('select', { title: 'Level; 0 is the finest' }),
      count: make('span', { className: 'count' }), badge: make('span', { className: 'badge', hidden: true }),
      prove: make('button', { textContent: 'Prove', title: `Asks bpcheck about ${layer.name}` }), loaded: null, asked: false, inner: layer.contract === 'inside',
    };
    row.color.setAttribute('aria-label', `Colour of ${layer.name}`);
    row.opacity.setAttribute('aria-label', `Opacity of ${layer.name}`);
    row.level.setAttribute('aria-label', `Level of ${layer.name}`);
    for (let n = 0; n < layer.levels; ++n) row.level.append(make('option', { value: String(n), textContent: `level ${n}` }));
    row.level.hidden = layer.levels < 2;
    row.shown.onchange = () => void this.update(i);
    row.level.onchange = () => { row.shown.checked = true; void this.update(i); };
    row.color.oninput = row.opacity.oninput = () => this.style(i);
    row.prove.onclick = () => { row.asked = true; this.prove(i); };
    if (i < 6) label.append(make('kbd', { textContent: String(i + 4) }));
    label.append(row.shown, make('span', { textContent: layer.name }));
    const what = layer.contract || (layer.kind === 'mesh' ? 'no claim' : layer.kind);
    head.append(row.color, label, row.badge, row.prove);
    foot.append(make('span', { className: 'what', textContent: what }), row.level, row.opacity, row.count);
    row.item.append(head, foot, make('p', { className: 'fine why' }));
    return row;
  }

  toggle(i: number): void {
    if (i >= this.rows.length) return;
    this.rows[i].shown.checked = !this.rows[i].shown.checked;
    void this.update(i);
  }

  /// Shows a level alone of all files; -1: no file.
  showOnly(i: number, level = 0): void {
    this.rows.forEach((row, at) => {
      row.shown.checked = at === i;
      if (at === i) row.level.value = String(level);
      void this.update(at);
    });
  }
  isShown(i: number, level: number): boolean { return this.rows[i].shown.checked && Number(this.rows[i].level.value) === level; }
  color(i: number): string { return this.rows[i].color.value; }

  /// Fetches what is shown with distances from the scene, or without.
  async showDistances(on: boolean): Promise<void> {
    this.distances = on;
    await Promise.all(this.rows.map((_, i) => this.update(i)));
  }

  private style(i: number): void {
    const row = this.rows[i];
    this.view.style(i, row.shown.checked, Number(row.opacity.value) / 100, row.color.value);
  }

  /// Fetches the level that is wanted, once it is shown. An answer that comes late is dropped.
  private async update(i: number): Promise<void> {
    const row = this.rows[i], wanted = `file=${i}&level=${row.level.value}&distances=${Number(this.distances)}`;
    if (row.shown.checked && row.loaded !== wanted) {
      row.loaded = wanted;
      row.count.textContent = '…';
      try {
        const mesh = readMesh(await bytes(`/api/layer?${wanted}`));
        if (row.loaded !== wanted) return;
        this.view.setFile(i, mesh, row.inner);
        row.count.textContent = mesh.faces.toLocaleString('en');
        this.told.loaded++;
      } catch (error) {
        row.loaded = null;
        row.shown.checked = false;
        row.count.textContent = '';
        complain(error);
      }
    }
    this.style(i);
    this.changed();
  }
}
