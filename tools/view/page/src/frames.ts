// Frames that turn the cubes of the closing: they are placed, moved and turned in the view, or by numbers (docs/bpscale.1.md).
import * as THREE from 'three';
import { TransformControls } from 'three/addons/controls/TransformControls.js';
import type { Frame, Orientation, State, Vec3 } from './api';
import { show } from './lengths';
import type { View } from './view';

const byId = <T extends HTMLElement>(id: string): T => document.getElementById(id) as T;
const kFields = ['x', 'y', 'z', 'rx', 'ry', 'rz'] as const;  // a place, and turns about the axes in degrees

function turnOf(frame: Frame['frame']): THREE.Quaternion {
  if (typeof frame[0] === 'number') {
    const [w, x, y, z] = frame as number[];
    return new THREE.Quaternion(x, y, z, w).normalize();
  }
  const [a, b] = (frame as Vec3[]).map((axis) => new THREE.Vector3(...axis)), first = a.normalize();
  const second = b.addScaledVector(first, -b.dot(first)).normalize();
  return new THREE.Quaternion().setFromRotationMatrix(new THREE.Matrix4().makeBasis(first, second, first.clone().cross(second)));
}

/// A cube with its axes; `size` is its edge.
function cube(size: number, chosen: boolean): THREE.Group {
  const group = new THREE.Group(), axes = new THREE.AxesHelper(size);
  const box = new THREE.LineSegments(new THREE.EdgesGeometry(new THREE.BoxGeometry(size, size, size)), new THREE.LineBasicMaterial({ color: chosen ? '#2463c9' : '#6a7380' }));
  group.add(axes, box);
  for (const lines of [axes, box]) Object.assign(lines.material, { depthTest: false, transparent: true, opacity: chosen ? 1 : 0.7 });
  group.renderOrder = 4;
  return group;
}

export class Frames {
  private frames: Frame[] = [];
  private told: Orientation = null;
  private chosen = -1;
  private group = new THREE.Group();
  private handle = new THREE.Object3D();  // what the gizmo moves
  private gizmo: TransformControls;
  private dragging = false;
  private moved = false;  // whether this drag was sent before
  private active = true;

  constructor(private view: View, private canvas: HTMLCanvasElement, private facts: () => State['scene'], private send: (value: Orientation, again: boolean) => void) {
    this.gizmo = new TransformControls(view.camera, canvas);
    this.gizmo.setSpace('local');
    this.gizmo.setSize(0.8);
    view.addTool(this.group, this.handle, this.gizmo.getHelper());
    this.gizmo.addEventListener('change', () => view.draw());
    this.gizmo.addEventListener('dragging-changed', (event) => {
      this.dragging = Boolean(event.value);
      view.controls.enabled = !this.dragging;
      this.moved = false;
    });
    this.gizmo.addEventListener('objectChange', () => this.change(this.handle.position, this.handle.quaternion, this.moved));
    for (const name of kFields) byId(`frame-${name}`).addEventListener('change', () => this.typed());
    for (const button of document.querySelectorAll<HTMLButtonElement>('[data-gizmo]')) {
      button.onclick = () => this.mode(button.dataset.gizmo as 'translate' | 'rotate');
    }
    this.mode('rotate');
    byId('cubes').addEventListener('toggle', () => this.show());
  }

  private mode(mode: 'translate' | 'rotate'): void {
    this.gizmo.setMode(mode);
    for (const button of document.querySelectorAll<HTMLButtonElement>('[data-gizmo]')) button.ariaPressed = String(button.dataset.gizmo === mode);
    this.view.draw();
  }
  /// The gizmo is there while the pointer turns the view, and not while it brushes.
  activate(on: boolean): void {
    this.active = on;
    this.show();
  }

  /// Returns where the chosen frame is on the page, in pixels; for tests.
  place(): [number, number] {
    return this.view.pixelOf(this.handle.position);
  }

  /// Adds an upright frame at a point of the scene, and chooses it.
  add(at: Vec3): void {
    this.frames = [...this.frames, { at: this.rounded(at), frame: [1, 0, 0, 0] }];
    this.chosen = this.frames.length - 1;
    byId<HTMLDetailsElement>('cubes').open = true;
    this.sendAll(false);
  }
  /// Makes cubes upright (null), or lets them stand as the scene does.
  choose(value: null | 'auto'): void {
    if (this.frames.length === 0 && this.told === value) return;
    this.frames = [];
    this.send(value, false);
  }
  private remove(i: number): void {
    this.frames = this.frames.filter((_, at) => at !== i);
    this.chosen = Math.min(this.chosen, this.frames.length - 1);
    this.sendAll(false);
  }

  /// Shows what the server has; while a person drags a frame, afterwards.
  tell(orientation: Orientation): void {
    this.told = orientation;
    if (this.dragging) return void setTimeout(() => { if (this.told === orientation) this.tell(orientation); }, 50);
    const text = JSON.stringify(this.frames), next = Array.isArray(orientation) ? orientation : [];
    if (next.length > 0 && this.frames.length === 0) byId<HTMLDetailsElement>('cubes').open = true;
    this.frames = next;
    if (this.chosen >= next.length || (this.chosen < 0 && next.length > 0)) this.chosen = next.length - 1;
    if (JSON.stringify(next) !== text) this.list();
    this.show();
  }

  private rounded(at: Vec3): Vec3 {
    const digits = Math.min(20, Math.max(0, 1 - Math.floor(Math.log10(this.facts().voxel / 4))));
    return at.map((x) => Number(x.toFixed(digits))) as Vec3;
  }
  /// `at` is relative to the middle of the scene.
  private change(at: THREE.Vector3, turn: THREE.Quaternion, again: boolean): void {
    const frame = [turn.w, turn.x, turn.y, turn.z].map((x) => Number(x.toFixed(5)));
    this.frames = this.frames.map((old, i) => (i === this.chosen ? { at: this.rounded(this.view.toScene(at)), frame } : old));
    this.moved = true;
    this.sendAll(again);
  }
  private typed(): void {
    const values = kFields.map((name) => Number(byId<HTMLInputElement>(`frame-${name}`).value.trim() || NaN));
    kFields.forEach((name, i) => byId(`frame-${name}`).classList.toggle('wrong', !Number.isFinite(values[i])));
    if (!values.every(Number.isFinite)) return;
    const [rx, ry, rz] = values.slice(3).map(THREE.MathUtils.degToRad);
    this.change(this.view.fromScene(values.slice(0, 3) as Vec3), new THREE.Quaternion().setFromEuler(new THREE.Euler(rx, ry, rz)), false);
  }
  private sendAll(again: boolean): void {
    this.send(this.frames.length > 0 ? this.frames : null, again);
    this.list();
    this.show();
  }

  private list(): void {
    byId('frames').replaceChildren(...this.frames.map((frame, i) => {
      const item = document.createElement('li'), name = document.createElement('button'), gone = document.createElement('button');
      name.textContent = `Frame ${i + 1} at ${frame.at.map((x) => show(x)).join('  ')}`;
      name.className = 'name';
      name.ariaPressed = String(i === this.chosen);
      name.onclick = () => { this.chosen = i; this.list(); this.show(); };
      gone.textContent = '×';
      gone.title = gone.ariaLabel = `Remove frame ${i + 1}`;
      gone.onclick = () => this.remove(i);
      item.append(name, gone);
      return item;
    }));
  }

  private show(): void {
    const open = byId<HTMLDetailsElement>('cubes').open, frame = this.frames[this.chosen];
    for (const button of document.querySelectorAll<HTMLButtonElement>('[data-cubes]'))
      button.ariaPressed = String(button.dataset.cubes === (this.frames.length > 0 ? 'frame' : this.told === 'auto' ? 'auto' : 'none'));
    byId('frame').hidden = !frame;
    this.group.clear();
    this.gizmo.detach();
    if (open) {
      this.frames.forEach((one, i) => {
        const shown = cube(this.facts().diagonal * 0.06, i === this.chosen);
        shown.position.copy(this.view.fromScene(one.at));
        shown.quaternion.copy(turnOf(one.frame));
        this.group.add(shown);
      });
    }
    if (frame) {
      const turn = turnOf(frame.frame), angles = new THREE.Euler().setFromQuaternion(turn);
      const values = [...frame.at, ...[angles.x, angles.y, angles.z].map((x) => Number(THREE.MathUtils.radToDeg(x).toFixed(2)))];
      kFields.forEach((name, i) => { if (document.activeElement !== byId(`frame-${name}`)) byId<HTMLInputElement>(`frame-${name}`).value = String(values[i]); });
      if (!this.dragging) {
        this.handle.position.copy(this.view.fromScene(frame.at));
        this.handle.quaternion.copy(turn);
      }
      if (open && this.active) this.gizmo.attach(this.handle);
    }
    this.view.draw();
  }
}
