// Sections of solids: where the cut plane goes through a closed layer, the layer is filled. For each layer the faces that a ray passes are
// counted in the stencil, back faces up and front faces down. Where the sum is not 0, the ray has entered the solid through the plane.
import * as THREE from 'three';
import { surfaceMaterial } from './looks';

/// A closed layer, with the lines of its group that bound nothing.
export interface Solid { group: THREE.Object3D; lines: THREE.Object3D[]; color: THREE.Color; opacity: number }

function counting(side: THREE.Side, step: THREE.StencilOp): THREE.Material {
  return new THREE.MeshBasicMaterial({ side, colorWrite: false, depthWrite: false, depthTest: false, stencilWrite: true, stencilFunc: THREE.AlwaysStencilFunc,
    stencilFail: step, stencilZFail: step, stencilZPass: step });
}
const kCounts = [counting(THREE.BackSide, THREE.IncrementWrapStencilOp), counting(THREE.FrontSide, THREE.DecrementWrapStencilOp)];
/// Properties of a material that is drawn only where the count is not 0.
export const kWhereCounted: THREE.MaterialParameters = { side: THREE.DoubleSide, stencilWrite: true, stencilFunc: THREE.NotEqualStencilFunc, stencilRef: 0 };
const kSheet = 4;  // edge of the sheet in the cut plane, in diagonals of the scene: proxies and cages are larger than the scene

/// Calls `act` while only some children of a scene are visible.
export function withOnly(scene: THREE.Scene, some: THREE.Object3D[], act: () => void): void {
  const visible = scene.children.map((child) => child.visible);
  for (const child of scene.children) child.visible = child.visible && some.includes(child);
  act();
  scene.children.forEach((child, i) => { child.visible = visible[i]; });
}

export class Caps {
  private look: THREE.MeshMatcapMaterial;
  private sheet: THREE.Mesh;
  private alone = new THREE.Scene();  // the sheet, which the plane does not cut

  constructor(matcap: THREE.Texture) {
    this.look = surfaceMaterial(matcap, '#ffffff', 'section', { ...kWhereCounted, transparent: true });
    this.sheet = new THREE.Mesh(new THREE.PlaneGeometry(1, 1), this.look);
    this.alone.add(this.sheet);
  }

  /// Draws over what is drawn already. `solids` come from the outermost to the innermost: where several are cut, the last one is seen.
  /// `depths`: a material in place of the layers' colours. The scene's background must be null.
  draw(renderer: THREE.WebGLRenderer, scene: THREE.Scene, camera: THREE.Camera, size: number, solids: Solid[], depths: THREE.Material | null = null): void {
    const planes = renderer.clippingPlanes, clears = renderer.autoClear, [plane] = planes;
    this.sheet.position.copy(plane.normal).multiplyScalar(-plane.constant);
    this.sheet.quaternion.setFromUnitVectors(new THREE.Vector3(0, 0, 1), plane.normal);
    this.sheet.scale.setScalar(kSheet * size);
    this.sheet.material = depths ?? this.look;
    renderer.autoClear = false;
    for (const solid of solids) {
      const lines = solid.lines.map((line) => line.visible);
      for (const line of solid.lines) line.visible = false;
      renderer.clear(false, false, true);
      withOnly(scene, [solid.group], () => {
        for (const count of kCounts) {
          scene.overrideMaterial = count;
          renderer.render(scene, camera);
        }
      });
      scene.overrideMaterial = null;
      solid.lines.forEach((line, i) => { line.visible = lines[i]; });
      this.look.color.copy(solid.color);
      this.look.opacity = solid.opacity;
      this.look.depthWrite = solid.opacity === 1;
      renderer.clippingPlanes = [];
      renderer.render(this.alone, camera);
      renderer.clippingPlanes = planes;
    }
    renderer.autoClear = clears;
  }
}
