// The ruler: a distance between two picked points.
import * as THREE from 'three';
import { onClick } from './clicks';
import { percent, show } from './lengths';
import type { State } from './api';
import type { View } from './view';

export class Ruler {
  private points: THREE.Vector3[] = [];
  active = false;

  constructor(private canvas: HTMLCanvasElement, private view: View, private facts: () => State['scene'], private label: HTMLElement, private text: HTMLElement) {
    onClick(canvas, () => this.active, (x, y) => this.take(x, y));
    view.drawn = () => this.place();
  }

  /// Takes the point under the cross in the middle of the view.
  takeMiddle(): void { this.take(this.canvas.clientWidth / 2, this.canvas.clientHeight / 2); }

  private take(x: number, y: number): void {
    const at = this.view.pick(x, y);
    if (!at) return void (this.text.textContent = 'No surface is there.');
    if (this.points.length === 2) this.points = [];
    this.points.push(at);
    this.apply();
  }
  clear(): void {
    this.points = [];
    this.apply();
  }

  private apply(): void {
    this.view.setRuler(this.points);
    const [a, b] = this.points, scene = this.facts();
    if (!a) this.text.textContent = '';
    else if (!b) this.text.textContent = `from ${this.view.toScene(a).map((x) => show(x, 5)).join('  ')}`;
    else {
      const d = a.distanceTo(b), along = b.clone().sub(a).toArray().map((x) => show(Math.abs(x)));
      this.text.textContent = `${show(d, 4)} in scene units, ${show(d / scene.voxel)} voxels, ${percent(d, scene)} of the diagonal; along x, y, z: ${along.join(', ')}`;
      this.label.textContent = `${show(d, 4)} · ${show(d / scene.voxel)} vx`;
    }
    this.place();
  }

  /// The label follows the middle of the line.
  private place(): void {
    const [a, b] = this.points;
    this.label.hidden = !b;
    if (!b) return;
    const p = a.clone().add(b).multiplyScalar(0.5).project(this.view.camera);
    this.label.hidden = p.z > 1;
    this.label.style.left = `${((p.x + 1) / 2) * this.canvas.clientWidth}px`;
    this.label.style.top = `${((1 - p.y) / 2) * this.canvas.clientHeight}px`;
  }
}
