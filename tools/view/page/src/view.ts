// Draws scene, closing, proxy and files around the middle of the scene, in scene units.
import * as THREE from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import type { State, Vec3 } from './api';
import { Caps, withOnly, type Solid } from './caps';
import { makeMatcap, shared } from './looks';
import { Picker } from './picker';
import { ShownPieces } from './pieces';
import { ShownLayer, ShownMesh, type Faces } from './shown';
import type { Mesh, Surface } from './wire';

export type Layer = 'scene' | 'closing' | 'proxy';
/// One of the three, or the number of a file.
export type AnyLayer = Layer | number;
const kNearest = 0.001;  // least distance from the camera that is drawn, in diagonals of the scene

/// Returns whether the browser draws without a GPU. Then a frame takes a third of the time if edges are not smoothed.
function drawsBySoftware(): boolean {
  const gl = document.createElement('canvas').getContext('webgl2');
  const info = gl?.getExtension('WEBGL_debug_renderer_info');  // Chromium tells it there alone
  const name = gl ? String(gl.getParameter(info ? info.UNMASKED_RENDERER_WEBGL : gl.RENDERER)) : '';
  gl?.getExtension('WEBGL_lose_context')?.loseContext();
  return /swiftshader|llvmpipe|softpipe|basic render/i.test(name);
}

export class View {
  readonly camera = new THREE.PerspectiveCamera(35, 1, 1, 10);
  readonly controls: OrbitControls;
  private renderer: THREE.WebGLRenderer;
  private scene = new THREE.Scene();
  private stroke = new THREE.Line(new THREE.BufferGeometry(), new THREE.LineBasicMaterial({ color: '#ffffff', depthTest: false, transparent: true }));
  private matcap = makeMatcap();
  private closing = new ShownPieces(this.matcap);
  private mesh = new ShownMesh(this.matcap, '#c9d1dc', { side: THREE.DoubleSide });
  private proxy = new ShownMesh(this.matcap, '#9fd0b4');
  private files: ShownMesh[] = [];
  private inner = new Set<ShownMesh>();  // files that lie inside the scene
  private caps = new Caps(this.matcap);
  private faces: Faces = 'edges';
  private plane: THREE.Plane | null = null;
  private filled = true;
  private layers: Record<Layer, ShownLayer> = { scene: this.mesh, closing: this.closing, proxy: this.proxy };
  private dark = matchMedia('(prefers-color-scheme: dark)');
  private ruler = new THREE.Line(new THREE.BufferGeometry(), new THREE.LineBasicMaterial({ color: '#d21f5b', depthTest: false, transparent: true }));
  private ends = new THREE.Points(this.ruler.geometry, new THREE.PointsMaterial({ color: '#d21f5b', size: 9, sizeAttenuation: false, depthTest: false, transparent: true }));
  private base = 0;
  private picker: Picker;
  private size = 1;
  private due = false;
  private facts!: State['scene'];
  private tools: THREE.Object3D[] = [];  // they are drawn, and no point of them is picked
  frames = 0;
  drawn: () => void = () => {};  // called after each frame

  constructor(private canvas: HTMLCanvasElement) {
    this.renderer = new THREE.WebGLRenderer({ canvas, antialias: !drawsBySoftware(), alpha: false, stencil: true });
    this.picker = new Picker(this.renderer, this.scene);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.zoomToCursor = true;
    this.controls.addEventListener('change', () => this.draw());
    this.stroke.renderOrder = 2;
    this.stroke.frustumCulled = this.ruler.frustumCulled = this.ends.frustumCulled = false;
    this.ruler.renderOrder = this.ends.renderOrder = 3;
    for (const name of ['scene', 'closing', 'proxy'] as const) {
      this.layers[name].nest(name);
      this.scene.add(this.layers[name].group);
    }
    this.scene.add(this.stroke, this.ruler, this.ends);
    this.dark.addEventListener('change', () => this.dress());
    this.dress();
    new ResizeObserver(() => this.resize()).observe(canvas);
  }

  addTool(...objects: THREE.Object3D[]): void {
    this.tools.push(...objects);
    this.scene.add(...objects);
  }

  /// Takes the colours that suit a light or a dark page.
  private dress(): void {
    this.scene.background = new THREE.Color(this.dark.matches ? '#1b1f25' : '#e4e8ee');
    for (const { edges: [edges] } of [this.proxy, ...this.files]) edges.material.color.set(this.dark.matches ? '#0c2b1c' : '#123c28');
    this.draw();
  }

  begin(state: State): void {
    this.facts = state.scene;
    this.size = state.scene.diagonal || 1;
    const up = state.scene.up, axis = 'xyz'.indexOf(up.slice(-1)), sign = up.startsWith('-') ? -1 : 1;
    this.camera.up.set(0, 0, 0).setComponent(axis, sign);
    const controls = this.controls as unknown as { _quat: THREE.Quaternion; _quatInverse: THREE.Quaternion };
    controls._quat.setFromUnitVectors(this.camera.up, new THREE.Vector3(0, 1, 0));
    controls._quatInverse.copy(controls._quat).invert();
    this.resize();
    this.frame();
  }

  /// Makes the scene fill the view, from the present direction; at first from the front, right and above.
  frame(): void {
    const up = this.camera.up, half = this.half();
    let from = this.camera.position.clone().sub(this.controls.target);
    if (from.lengthSq() < 1e-30 || this.frames === 0) {
      const front = Math.abs(up.z) > 0.5 ? new THREE.Vector3(0, -1, 0) : Math.abs(up.y) > 0.5 ? new THREE.Vector3(0, 0, 1) : new THREE.Vector3(0, 1, 0);
      const right = new THREE.Vector3().crossVectors(up, front);
      from = front.multiplyScalar(0.78).addScaledVector(right, 0.52).addScaledVector(up, 0.36);
    }
    const angle = THREE.MathUtils.degToRad(this.camera.fov / 2);
    const distance = (half.length() * 0.92) / Math.sin(Math.min(angle, Math.atan(Math.tan(angle) * this.camera.aspect)));
    this.controls.target.set(0, 0, 0);
    this.camera.position.copy(from.setLength(distance));
    this.controls.minDistance = this.size / 100;
    this.controls.maxDistance = this.size * 8;
    this.controls.update();
    this.draw();
  }

  setScene(mesh: Mesh): void {
    this.mesh.set(mesh);
    this.restyle();
  }

  setSurface(surface: Surface): void {
    this.closing.set(surface, this.facts.middle);
    this.setBase(this.base);
    this.restyle();
  }

  setProxy(mesh: Mesh | null): void {
    this.proxy.set(mesh);
    this.restyle();
  }

  /// Colours the proxy and the files by their distance from the scene, where the server told it; false: not.
  /// Returns the farthest distance of what is shown.
  colorByDistance(on: boolean): number {
    const all = [this.proxy, ...this.files];
    const farthest = Math.max(0, ...all.filter((shown) => shown.group.visible).map((shown) => shown.farthest));
    shared.uFarthest.value = farthest || 1;
    for (const shown of all) shown.colorByDistance(on);
    this.draw();
    return farthest;
  }

  setFaces(faces: Faces): void {
    this.faces = faces;
    for (const shown of [this.proxy, ...this.files]) shown.setFaces(faces);
    this.draw();
  }

  /// Turns the view around its target by angles, moves it by shares of its distance, or goes nearer by a factor.
  turn(right: number, up: number): void {
    const offset = this.camera.position.clone().sub(this.controls.target), axis = this.camera.up;
    const side = new THREE.Vector3().crossVectors(axis, offset).normalize();
    const angle = Math.min(Math.PI - 0.02, Math.max(0.02, offset.angleTo(axis) - up)) - offset.angleTo(axis);
    offset.applyAxisAngle(side, angle).applyAxisAngle(axis, right);
    this.camera.position.copy(this.controls.target).add(offset);
    this.controls.update();
  }
  pan(right: number, up: number): void {
    const distance = this.camera.position.distanceTo(this.controls.target);
    const step = new THREE.Vector3(right, up, 0).multiplyScalar(distance).applyQuaternion(this.camera.quaternion);
    this.camera.position.add(step);
    this.controls.target.add(step);
    this.controls.update();
  }
  zoom(by: number): void {
    this.camera.position.sub(this.controls.target).multiplyScalar(by).add(this.controls.target);
    this.controls.update();
  }

  /// `inner`: the file lies inside the scene.
  setFile(i: number, mesh: Mesh, inner: boolean): void {
    while (this.files.length <= i) {
      const file = new ShownMesh(this.matcap, '#ffffff', { side: this.closing.looks[0].side });
      this.files.push(file);
      file.nest('outer');
      file.setFaces(this.faces);
      this.scene.add(file.group);
      file.group.visible = false;
    }
    this.files[i].set(mesh);
    if (inner) {
      this.inner.add(this.files[i]);
      this.files[i].nest('inner');
    }
    this.dress();
    this.restyle();
  }
  /// `opacity` counts beside other layers.
  style(which: AnyLayer, visible: boolean, opacity: number, color?: string): void {
    const layer = typeof which === 'number' ? this.files[which] : this.layers[which];
    if (!layer) return;  // a file that was not shown yet
    layer.group.visible = visible;
    layer.wanted = opacity;
    if (color) layer.looks[0].color.set(color);
    this.restyle();
  }
  private all(): ShownLayer[] { return [this.mesh, this.closing, this.proxy, ...this.files]; }
  private seen(): ShownLayer[] { return this.all().filter((layer) => layer.group.visible && !layer.empty); }
  /// A layer that is shown alone is opaque: there is nothing that it could hide.
  private restyle(): void {
    const seen = this.seen();
    for (const layer of this.all()) layer.setOpacity(seen.length === 1 && seen[0] === layer ? 1 : layer.wanted);
    this.draw();
  }

  half(): THREE.Vector3 {
    return new THREE.Vector3(...this.facts.max).sub(new THREE.Vector3(...this.facts.min)).multiplyScalar(0.5);
  }

  /// Leaves out what lies behind `plane`. Closed layers are filled there if `filled`. Others are open, and are drawn from both sides.
  cut(plane: THREE.Plane | null, filled: boolean): void {
    this.renderer.clippingPlanes = plane ? [plane] : [];
    this.plane = plane;
    this.filled = filled;
    const side = plane ? THREE.DoubleSide : THREE.FrontSide;
    for (const look of [this.closing, this.proxy, ...this.files].flatMap((shown: ShownLayer) => shown.looks)) {
      if (look.side !== side) look.needsUpdate = true;
      look.side = side;
    }
    this.draw();
  }

  setBase(world: number): void {
    this.base = world;
    shared.uBase.value = (world / (this.closing.voxel || this.facts.voxel)) * 16 || 1;
    this.draw();
  }

  /// Places the brush: scene units, relative to the middle; null: no brush.
  setBrush(at: THREE.Vector3 | null, radius: number, color: string): void {
    shared.uBrush.value.set(at?.x ?? 0, at?.y ?? 0, at?.z ?? 0, at ? radius : 0);
    shared.uBrushColor.value.set(color);
    this.draw();
  }

  setRuler(points: THREE.Vector3[]): void {
    this.ruler.geometry.dispose();
    this.ruler.geometry = this.ends.geometry = new THREE.BufferGeometry().setFromPoints(points);
    this.draw();
  }

  setStroke(points: THREE.Vector3[]): void {
    this.stroke.geometry.dispose();
    this.stroke.geometry = new THREE.BufferGeometry().setFromPoints(points);
    this.stroke.visible = points.length > 1;
    this.draw();
  }

  /// Returns the visible point there, relative to the middle. Transparent layers are ignored, unless all are transparent.
  pick(x: number, y: number): THREE.Vector3 | null {
    const hidden: THREE.Object3D[] = [this.stroke, this.ruler, this.ends, ...this.tools], seen = this.seen();
    const least = Math.min(1, Math.max(...seen.map((layer) => layer.opacity)));
    for (const layer of seen) hidden.push(...(layer.opacity < least ? [layer.group] : layer.edges));
    this.focus();
    const fill = (depths: THREE.Material) => this.caps.draw(this.renderer, this.scene, this.camera, this.size, this.solids().filter((solid) => solid.opacity >= least), depths);
    return this.picker.pick(this.camera, x, y, this.canvas.clientWidth, this.canvas.clientHeight, hidden, this.plane && this.filled ? fill : () => {});
  }

  /// Returns where a point relative to the middle is on the page, in pixels; for tests.
  pixelOf(p: THREE.Vector3): [number, number] {
    const q = p.clone().project(this.camera), box = this.canvas.getBoundingClientRect();
    return [box.x + ((q.x + 1) / 2) * box.width, box.y + ((1 - q.y) / 2) * box.height];
  }

  toScene(p: THREE.Vector3): Vec3 {
    const m = this.facts.middle;
    return [p.x + m[0], p.y + m[1], p.z + m[2]];
  }

  fromScene(p: Vec3): THREE.Vector3 {
    return new THREE.Vector3(...p).sub(new THREE.Vector3(...this.facts.middle));
  }

  private resize(): void {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    if (!width || !height) return;
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.draw();
  }

  /// The visible layers that are closed, from the outermost to the innermost.
  private solids(): Solid[] {
    const of = (shown: ShownLayer): Solid[] => (shown.group.visible && shown.closed ? [shown.solid] : []);
    const [inner, outer] = [true, false].map((inside) => this.files.filter((file) => this.inner.has(file) === inside).flatMap(of));
    return [...outer, ...of(this.proxy), ...of(this.closing), ...of(this.mesh), ...inner];
  }

  /// Lets the camera see just what is drawn: the depth buffer tells 2^24 distances apart, most of them close to the nearest.
  private focus(): void {
    const { camera } = this, distance = camera.position.length();
    const reach = 1.01 * Math.max(0.75 * this.size, ...this.seen().map((layer) => layer.radius), ...this.tools.map((tool) => tool.position.length() + 0.2 * this.size));
    camera.far = distance + reach;
    camera.near = Math.max(distance - reach, kNearest * this.size);
    camera.updateProjectionMatrix();
  }

  /// With a cut, what marks places is drawn last, and whole.
  private render(): void {
    const { renderer, scene, camera } = this;
    this.focus();
    if (!this.plane) return renderer.render(scene, camera);
    const marks = [this.stroke, this.ruler, this.ends, ...this.tools], background = scene.background;
    withOnly(scene, scene.children.filter((child) => !marks.includes(child)), () => renderer.render(scene, camera));
    scene.background = null;
    if (this.filled) this.caps.draw(renderer, scene, camera, this.size, this.solids());
    [renderer.autoClear, renderer.clippingPlanes] = [false, []];
    withOnly(scene, marks, () => renderer.render(scene, camera));
    [renderer.autoClear, renderer.clippingPlanes, scene.background] = [true, [this.plane], background];
  }

  draw(): void {
    if (this.due) return;
    this.due = true;
    requestAnimationFrame(() => {
      this.due = false;
      if (this.facts) this.frames++;
      this.render();
      this.drawn();
    });
  }
}
