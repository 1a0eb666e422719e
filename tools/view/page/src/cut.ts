// The cut plane: what lies before it is left out, in all layers. Closed layers are filled there; the back faces of others get a colour of their own.
import * as THREE from 'three';
import { shared } from './looks';
import { show } from './lengths';
import type { View } from './view';

export const kCuts = ['off', 'x', 'y', 'z', 'view'] as const;
export type CutAxis = (typeof kCuts)[number];

export class Cut {
  private axis: CutAxis = 'off';
  private at = 500;           // 0: nothing is left out; 1000: everything
  private along = new THREE.Vector3();  // unit length; from what is left out to what is kept
  private plane = new THREE.Plane();

  constructor(private view: View, private slider: HTMLInputElement, private text: HTMLElement, private buttons: HTMLButtonElement[], flip: HTMLButtonElement, private fill: HTMLInputElement) {
    slider.oninput = () => { this.at = Number(slider.value); this.apply(); };
    for (const button of buttons) button.onclick = () => this.choose(button.dataset.cut as CutAxis);
    flip.onclick = () => this.flip();
    fill.onchange = () => this.apply();
    this.apply();
  }

  choose(axis: CutAxis): void {
    this.axis = axis;
    const forward = this.view.camera.getWorldDirection(new THREE.Vector3());
    if (axis === 'view') this.along.copy(forward);
    else if (axis !== 'off') {
      // The side of the viewer is left out, so that one looks into what is kept.
      const i = 'xyz'.indexOf(axis);
      this.along.set(0, 0, 0).setComponent(i, forward.getComponent(i) < 0 ? -1 : 1);
    }
    this.apply();
  }
  next(): void { this.choose(kCuts[(kCuts.indexOf(this.axis) + 1) % kCuts.length]); }

  /// Leaves out the other side of the same plane.
  flip(): void {
    this.along.negate();
    this.at = 1000 - this.at;
    this.apply();
  }
  /// Fills closed layers where they are cut, or leaves them hollow.
  toggleFill(): void {
    this.fill.checked = !this.fill.checked;
    this.apply();
  }
  move(by: number): void {
    if (this.axis === 'off') return;
    this.at = Math.min(1000, Math.max(0, this.at + by));
    this.apply();
  }

  /// Half the length of the scene along a direction, and some more, since proxies are larger.
  private reach(): number {
    const half = this.view.half();
    return 1.1 * (this.axis === 'view' ? half.length() : half.dot(new THREE.Vector3(Math.abs(this.along.x), Math.abs(this.along.y), Math.abs(this.along.z))));
  }

  apply(): void {
    const on = this.axis !== 'off', place = on ? this.reach() * (this.at / 500 - 1) : 0;
    this.plane.set(this.along, -place);
    shared.uCut.value = on ? 1 : 0;
    this.view.cut(on ? this.plane : null, this.fill.checked);
    this.slider.value = String(this.at);
    this.slider.disabled = !on;
    for (const button of this.buttons) button.ariaPressed = String(button.dataset.cut === this.axis);
    const i = 'xyz'.indexOf(this.axis);
    this.text.textContent = !on ? '' : this.axis === 'view' ? `${show(place)} behind the middle, as you looked when you chose it`
      : `${this.axis} = ${show(this.view.toScene(this.along.clone().multiplyScalar(place))[i], 4)}; ${this.along.getComponent(i) > 0 ? 'smaller' : 'larger'} ones are left out`;
  }
}
