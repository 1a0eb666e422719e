// The mirror plane: a stroke on one side is made on the other side, too, as a rule of its own.
import * as THREE from 'three';
import type { Rule, State, Vec3 } from './api';
import { show } from './lengths';
import type { View } from './view';

export const kMirrors = ['off', 'x', 'y', 'z'] as const;
export type MirrorAxis = (typeof kMirrors)[number];

export class Mirror {
  private axis: MirrorAxis = 'off';
  private at = 0;  // of the plane along its axis, scene units
  private plane = new THREE.Group();

  constructor(private view: View, private facts: () => State['scene'], private place: HTMLInputElement, private buttons: HTMLButtonElement[]) {
    view.addTool(this.plane);
    for (const button of buttons) button.onclick = () => this.choose(button.dataset.mirror as MirrorAxis);
    place.addEventListener('change', () => {
      const at = Number(place.value.trim() || NaN);
      place.classList.toggle('wrong', !Number.isFinite(at));
      if (Number.isFinite(at)) this.at = at;
      this.apply();
    });
    this.apply();
  }

  /// The plane goes through the middle of the scene, until a person moves it.
  choose(axis: MirrorAxis): void {
    this.axis = axis;
    if (axis !== 'off') this.at = Number(show(this.facts().middle['xyz'.indexOf(axis)], 6));
    this.apply();
  }
  next(): void { this.choose(kMirrors[(kMirrors.indexOf(this.axis) + 1) % kMirrors.length]); }

  /// Returns the rule, and its mirror image if there is a plane.
  both(rule: Rule): Rule | Rule[] {
    if (this.axis === 'off' || !rule.at) return rule;
    const i = 'xyz'.indexOf(this.axis);
    const image = (p: Vec3): Vec3 => p.map((x, k) => (k === i ? Number((2 * this.at - x).toPrecision(12)) : x)) as Vec3;
    const at = Array.isArray(rule.at[0]) ? (rule.at as Vec3[]).map(image) : image(rule.at as Vec3);
    return [rule, { ...rule, at }];
  }

  private apply(): void {
    for (const button of this.buttons) button.ariaPressed = String(button.dataset.mirror === this.axis);
    this.place.disabled = this.axis === 'off';
    if (document.activeElement !== this.place) this.place.value = this.axis === 'off' ? '' : String(this.at);
    this.plane.clear();
    if (this.axis !== 'off') {
      const i = 'xyz'.indexOf(this.axis), half = this.view.half().multiplyScalar(1.15), size = [half.x, half.y, half.z];
      const [j, k] = [(i + 1) % 3, (i + 2) % 3];
      const corners = [[-1, -1], [1, -1], [1, 1], [-1, 1]].map(([a, b]) => new THREE.Vector3().setComponent(j, a * size[j]).setComponent(k, b * size[k]));
      const middle = this.facts().middle;
      const geometry = new THREE.BufferGeometry().setFromPoints(corners);
      geometry.setIndex([0, 1, 2, 0, 2, 3]);
      const outline = new THREE.LineLoop(new THREE.BufferGeometry().setFromPoints(corners), new THREE.LineBasicMaterial({ color: '#2463c9' }));
      const sheet = new THREE.Mesh(geometry, new THREE.MeshBasicMaterial({ color: '#2463c9', transparent: true, opacity: 0.1, side: THREE.DoubleSide, depthWrite: false }));
      this.plane.add(outline, sheet);
      this.plane.position.set(0, 0, 0).setComponent(i, this.at - middle[i]);
    }
    this.view.draw();
  }
}
