// Strokes of the pointer on the surface, and the rules that they become (docs/bpscale.1.md).
import * as THREE from 'three';
import type { Rule, Vec3 } from './api';
import { toWorld, type Length } from './lengths';
import type { State } from './api';
import type { View } from './view';

export type Tool = 'turn' | 'ruler' | 'part' | 'decrease' | 'increase' | 'erase';
export const kColors: Record<Tool, string> = { turn: '#888888', ruler: '#888888', part: '#888888', decrease: '#2f6fd6', increase: '#d9711f', erase: '#7a8594' };
const kSendEvery = 120;  // ms, while a stroke is drawn
const kMostPoints = 400;

export class Brush {
  tool: Tool = 'turn';
  radius: Length = '3%';
  target: Length = '0.5%';
  private points: THREE.Vector3[] = [];
  private drawing = false;
  private sent = 0;
  private last: PointerEvent | null = null;
  private pending = false;

  constructor(private canvas: HTMLCanvasElement, private view: View, private facts: () => State['scene'],
    private send: (rule: Rule | Rule[], again: boolean) => void, private both: (rule: Rule) => Rule | Rule[], private hover: (at: Vec3 | null) => void) {
    // This listener comes before OrbitControls, so a stroke that begins on the surface does not turn the view.
    canvas.addEventListener('pointerdown', (event) => this.down(event), { capture: true });
    canvas.addEventListener('pointermove', (event) => { this.last = event; this.schedule(); });
    canvas.addEventListener('pointerup', (event) => this.up(event));
    canvas.addEventListener('pointercancel', (event) => this.up(event));
    canvas.addEventListener('pointerleave', () => { if (!this.drawing) { this.last = null; this.view.setBrush(null, 0, '#000'); this.hover(null); } });
  }

  get paints(): boolean { return this.tool === 'decrease' || this.tool === 'increase' || this.tool === 'erase'; }
  get world(): number { return toWorld(this.radius, this.facts()); }

  private pickAt(event: PointerEvent): THREE.Vector3 | null {
    const box = this.canvas.getBoundingClientRect();
    return this.view.pick(event.clientX - box.left, event.clientY - box.top);
  }

  private down(event: PointerEvent): void {
    if (event.button !== 0 || !this.paints || event.altKey) return;
    const at = this.pickAt(event);
    if (!at) return;  // a drag that begins beside the surface turns the view
    event.stopImmediatePropagation();
    event.preventDefault();
    this.canvas.parentElement?.focus();
    this.canvas.setPointerCapture(event.pointerId);
    this.drawing = true;
    this.points = [at];
    this.sent = performance.now();
    this.send(this.rule(), false);
    this.view.setStroke(this.points);
  }

  private up(event: PointerEvent): void {
    if (!this.drawing) return;
    this.drawing = false;
    this.last = event;
    this.track();
    this.view.setStroke([]);
    if (this.points.length > 1) this.send(this.rule(), true);
  }

  /// Looks at the surface once a frame, however many events come.
  private schedule(): void {
    if (this.pending) return;
    this.pending = true;
    requestAnimationFrame(() => { this.pending = false; this.track(); });
  }

  private track(): void {
    if (!this.last || (this.last.buttons !== 0 && !this.drawing)) return;
    const at = this.pickAt(this.last);
    this.hover(at && this.view.toScene(at));
    this.view.setBrush(this.paints ? at : null, this.world, kColors[this.tool]);
    if (!this.drawing || !at) return;
    if (at.distanceTo(this.points[this.points.length - 1]) < this.world / 4 || this.points.length >= kMostPoints) return;
    this.points.push(at);
    this.view.setStroke(this.points);
    if (performance.now() - this.sent < kSendEvery) return;
    this.sent = performance.now();
    this.send(this.rule(), true);
  }

  private rule(): Rule | Rule[] {
    const step = Math.pow(10, Math.floor(Math.log10(this.facts().voxel / 4)));
    const digits = Math.max(0, Math.round(-Math.log10(step)));
    const all = this.points.map((p) => this.view.toScene(p).map((x) => Number(x.toFixed(Math.min(digits, 20)))) as Vec3);
    const rule: Rule = { at: all.length === 1 ? all[0] : all, radius: this.radius, mode: this.tool };
    if (this.tool !== 'erase') rule.scale = this.target;
    return this.both(rule);
  }
}
