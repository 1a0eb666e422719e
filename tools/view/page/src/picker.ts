// Finds the point of the surface under the pointer: one pixel is drawn with distances in place of colours. So pieces that arrive
// with each stroke need no search tree of their own.
import * as THREE from 'three';
import { kWhereCounted } from './caps';

/// Writes distances in place of colours.
function depths(more: THREE.MaterialParameters): THREE.ShaderMaterial {
  return new THREE.ShaderMaterial({
    side: THREE.DoubleSide,
    ...more,
    clipping: true,  // by the cut plane
    uniforms: { uFar: { value: 1 } },
    vertexShader: `varying float vDepth;
      #include <clipping_planes_pars_vertex>
      void main() {
        vec4 mvPosition = modelViewMatrix * vec4(position, 1.0);
        #include <clipping_planes_vertex>
        vDepth = -mvPosition.z;
        gl_Position = projectionMatrix * mvPosition;
      }`,
    fragmentShader: `varying float vDepth; uniform float uFar;
      #include <clipping_planes_pars_fragment>
      void main() {
        #include <clipping_planes_fragment>
        float d = clamp(vDepth / uFar, 0.0, 0.999999);
        vec3 part = fract(d * vec3(1.0, 255.0, 65025.0));
        part -= part.yzz * vec3(1.0 / 255.0, 1.0 / 255.0, 0.0);
        gl_FragColor = vec4(part, 1.0);
      }`,
  });
}

export class Picker {
  private target = new THREE.WebGLRenderTarget(1, 1, { stencilBuffer: true });
  private material = depths({});
  private section = depths(kWhereCounted);
  private pixel = new Uint8Array(4);

  constructor(private renderer: THREE.WebGLRenderer, private scene: THREE.Scene) {}

  /// Returns the point at pixel (`x`, `y`) of the canvas; null: the background. `fill` draws the sections of a cut with the material that it gets.
  pick(camera: THREE.PerspectiveCamera, x: number, y: number, width: number, height: number, hidden: THREE.Object3D[], fill: (depths: THREE.Material) => void): THREE.Vector3 | null {
    const far = camera.far;
    this.material.uniforms.uFar.value = this.section.uniforms.uFar.value = far;
    const visible = hidden.map((object) => object.visible);
    hidden.forEach((object) => { object.visible = false; });
    const background = this.scene.background;
    this.scene.background = null;
    this.scene.overrideMaterial = this.material;
    camera.setViewOffset(width, height, x, y, 1, 1);
    const clear = new THREE.Color(), alpha = this.renderer.getClearAlpha();
    this.renderer.getClearColor(clear);
    this.renderer.setClearColor(0, 0);
    this.renderer.setRenderTarget(this.target);
    this.renderer.clear();
    this.renderer.render(this.scene, camera);
    this.scene.overrideMaterial = null;
    fill(this.section);
    this.renderer.readRenderTargetPixels(this.target, 0, 0, 1, 1, this.pixel);
    this.renderer.setRenderTarget(null);
    this.renderer.setClearColor(clear, alpha);
    camera.clearViewOffset();
    this.scene.background = background;
    hidden.forEach((object, i) => { object.visible = visible[i]; });
    const [a, b, c, there] = this.pixel;
    if (there === 0) return null;
    const depth = (a / 255 + b / 255 / 255 + c / 255 / 65025) * far;
    const p = new THREE.Vector3((2 * (x + 0.5)) / width - 1, 1 - (2 * (y + 0.5)) / height, 0.5).unproject(camera);
    const forward = camera.getWorldDirection(new THREE.Vector3()), ray = p.sub(camera.position).normalize();
    return camera.position.clone().addScaledVector(ray, depth / ray.dot(forward));
  }
}
