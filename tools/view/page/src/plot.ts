// Faces against error and volume, for the proxies of this session and for files that were proven. A point shows its proxy.
import { percent, show } from './lengths';
import type { State } from './api';

export interface PlotPoint { name: string; faces: number; error: number | null; volume: number | null; color: string; current: boolean; act: () => void }

const kWidth = 288, kHeight = 118, kLeft = 40, kRight = 8, kTop = 8, kBottom = 20;

function svg(tag: string, attributes: Record<string, string | number>, text = ''): SVGElement {
  const element = document.createElementNS('http://www.w3.org/2000/svg', tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, String(value));
  element.textContent = text;
  return element;
}

/// Maps values to pixels by powers, with some room at the ends.
class Axis {
  private low: number;
  private high: number;
  constructor(values: number[], private from: number, private to: number) {
    this.low = Math.log(Math.min(...values));
    this.high = Math.log(Math.max(...values));
    const room = Math.max(0.08 * (this.high - this.low), 0.25);
    this.low -= room;
    this.high += room;
  }
  at(value: number): number { return this.from + ((Math.log(value) - this.low) / (this.high - this.low)) * (this.to - this.from); }
  /// The round numbers within: powers of ten, and 2 and 5 times these where there is room.
  ticks(): number[] {
    const all: number[] = [], factors = this.high - this.low > 5 ? [1] : this.high - this.low > 1.5 ? [1, 2, 5] : [1, 1.5, 2, 3, 4, 5, 6, 7, 8, 9];
    for (let p = Math.floor(this.low / Math.LN10); p <= Math.ceil(this.high / Math.LN10); ++p) {
      for (const f of factors) {
        const value = Number((f * Math.pow(10, p)).toPrecision(3));
        if (Math.log(value) >= this.low && Math.log(value) <= this.high) all.push(value);
      }
    }
    return all.length > 6 ? all.filter((_, i) => i % Math.ceil(all.length / 6) === 0) : all;
  }
}

function short(value: number): string { return value >= 10000 ? `${show(value / 1000, 2)}k` : show(value, 2); }

/// One chart: `valueOf` against faces. Points without a value are left out.
function chart(title: string, points: PlotPoint[], valueOf: (p: PlotPoint) => number | null, told: (p: PlotPoint) => string): SVGElement {
  const plot = svg('svg', { viewBox: `0 0 ${kWidth} ${kHeight}`, role: 'group', 'aria-label': `${title} against faces` });
  const there = points.filter((p) => p.faces > 0 && (valueOf(p) ?? 0) > 0);
  if (there.length === 0) return plot;
  const x = new Axis(there.map((p) => p.faces), kLeft, kWidth - kRight), y = new Axis(there.map((p) => valueOf(p)!), kHeight - kBottom, kTop);
  for (const t of x.ticks()) {
    plot.append(svg('line', { x1: x.at(t), x2: x.at(t), y1: kTop, y2: kHeight - kBottom, class: 'grid' }),
      svg('text', { x: x.at(t), y: kHeight - 7, 'text-anchor': 'middle' }, short(t)));
  }
  for (const t of y.ticks()) {
    plot.append(svg('line', { x1: kLeft, x2: kWidth - kRight, y1: y.at(t), y2: y.at(t), class: 'grid' }),
      svg('text', { x: kLeft - 5, y: y.at(t) + 3.5, 'text-anchor': 'end' }, short(t)));
  }
  for (const p of there) {
    const dot = svg('circle', { cx: x.at(p.faces), cy: y.at(valueOf(p)!), r: p.current ? 5.5 : 4, fill: p.color, class: p.current ? 'current' : '', tabindex: 0, role: 'button', 'aria-label': told(p) });
    dot.append(svg('title', {}, told(p)));
    dot.addEventListener('click', p.act);
    dot.addEventListener('keydown', (event) => {
      if ((event as KeyboardEvent).key !== 'Enter' && (event as KeyboardEvent).key !== ' ') return;
      event.preventDefault();
      event.stopPropagation();
      p.act();
    });
    plot.append(dot);
  }
  return plot;
}

export class Plot {
  private drawn = '';
  constructor(private box: HTMLElement) {}

  tell(points: PlotPoint[], scene: State['scene']): void {
    // Drawn anew only if something changes, so that a point keeps the focus.
    const text = JSON.stringify(points);
    if (text === this.drawn) return;
    this.drawn = text;
    const focused = [...this.box.querySelectorAll('circle')].findIndex((dot) => dot === document.activeElement);
    const told = (p: PlotPoint) => [p.name, `${p.faces.toLocaleString('en')} faces`, p.error !== null ? `farthest from the scene ${show(p.error)} (${percent(p.error, scene)})` : '',
      p.volume !== null ? `volume ${show(p.volume)} of the scene’s` : ''].filter(Boolean).join(', ');
    const heading = (words: string) => Object.assign(document.createElement('p'), { className: 'fine', textContent: words });
    this.box.replaceChildren(...(points.length === 0 ? [heading('Proxies that were made and checked, and files that were proven, appear here.')] : [
      heading('farthest from the scene, against faces'), chart('farthest', points, (p) => p.error, told),
      heading('volume as a share of the scene’s, against faces'), chart('volume', points, (p) => p.volume, told)]));
    if (focused >= 0) this.box.querySelectorAll('circle')[focused]?.focus();
  }
}
