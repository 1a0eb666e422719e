// Draws scene, closing, proxy and files around the middle of the scene, in scene units.
import * as THREE from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import type { State, Vec3 } from './api';
import { Caps, withOnly, type Solid } from './caps';
import { makeMatcap, shared, surfaceMaterial } from './looks';
import { Picker } from './picker';
import { ShownMesh } from './shown';
import type { Mesh, Surface } from './wire';

export type Layer = 'scene' | 'closing' | 'proxy';
const kBrick = 64, kPerVoxel = 256, kOrigin = 8;  // lib/live/surface_piece.h

export class View {
  readonly camera = new THREE.PerspectiveCamera(35, 1, 1, 10);
  readonly controls: OrbitControls;
  private renderer: THREE.WebGLRenderer;
  private scene = new THREE.Scene();
  private stroke = new THREE.Line(new THREE.BufferGeometry(), new THREE.LineBasicMaterial({ color: '#ffffff', depthTest: false, transparent: true }));
  private matcap = makeMatcap();
  private closingLook = surfaceMaterial(this.matcap, '#d8d4cc', 'scale');
  // The scene lies farther back than what encloses it closely, to within the digits of the depth buffer.
  private mesh = new ShownMesh(this.matcap, '#c9d1dc', { side: THREE.DoubleSide, polygonOffsetFactor: 2, polygonOffsetUnits: 8 });
  private proxy = new ShownMesh(this.matcap, '#9fd0b4');
  private files: ShownMesh[] = [];
  private inner = new Set<ShownMesh>();  // files that lie inside the scene
  private caps = new Caps(this.matcap);
  private plane: THREE.Plane | null = null;
  private filled = true;
  private layers: Record<Layer, THREE.Group> = { scene: this.mesh.group, closing: new THREE.Group(), proxy: this.proxy.group };
  private dark = matchMedia('(prefers-color-scheme: dark)');
  private ruler = new THREE.Line(new THREE.BufferGeometry(), new THREE.LineBasicMaterial({ color: '#d21f5b', depthTest: false, transparent: true }));
  private ends = new THREE.Points(this.ruler.geometry, new THREE.PointsMaterial({ color: '#d21f5b', size: 9, sizeAttenuation: false, depthTest: false, transparent: true }));
  private pieces = new Map<string, THREE.Mesh>();
  private drawnVoxel = 0;  // edge of the voxels of the pieces
  private base = 0;
  private picker: Picker;
  private size = 1;
  private due = false;
  private facts!: State['scene'];
  private tools: THREE.Object3D[] = [];  // they are drawn, and no point of them is picked
  frames = 0;
  drawn: () => void = () => {};  // called after each frame

  constructor(private canvas: HTMLCanvasElement) {
    this.renderer = new THREE.WebGLRenderer({ canvas, antialias: true, alpha: false, stencil: true });
    this.picker = new Picker(this.renderer, this.scene);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.zoomToCursor = true;
    this.controls.addEventListener('change', () => this.draw());
    this.stroke.renderOrder = 2;
    this.stroke.frustumCulled = this.ruler.frustumCulled = this.ends.frustumCulled = false;
    this.ruler.renderOrder = this.ends.renderOrder = 3;
    this.scene.add(this.layers.scene, this.layers.closing, this.layers.proxy, this.stroke, this.ruler, this.ends);
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
    for (const { edges } of [this.proxy, ...this.files]) edges.material.color.set(this.dark.matches ? '#0c2b1c' : '#123c28');
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
    this.camera.near = this.size / 500;
    this.camera.far = this.size * 12;
    this.camera.updateProjectionMatrix();
    this.controls.minDistance = this.size / 100;
    this.controls.maxDistance = this.size * 8;
    this.controls.update();
    this.draw();
  }

  setScene(mesh: Mesh): void {
    this.mesh.set(mesh);
    this.draw();
  }

  private removePiece(key: string): void {
    const old = this.pieces.get(key);
    if (!old) return;
    old.geometry.dispose();
    this.layers.closing.remove(old);
    this.pieces.delete(key);
  }

  setSurface({ whole, voxel, origin, pieces }: Surface): void {
    const { middle } = this.facts;
    if (whole) [...this.pieces.keys()].forEach((key) => this.removePiece(key));
    this.drawnVoxel = voxel;
    this.setBase(this.base);
    for (const piece of pieces) {
      this.removePiece(piece.key);
      if (piece.vertices === 0) continue;
      const geometry = new THREE.BufferGeometry();
      const words = new THREE.InterleavedBuffer(new Uint16Array(piece.bytes), 6), small = new THREE.InterleavedBuffer(new Int8Array(piece.bytes), 12);
      geometry.setAttribute('position', new THREE.InterleavedBufferAttribute(words, 3, 0));
      geometry.setAttribute('aValue', new THREE.InterleavedBufferAttribute(words, 1, 3));
      geometry.setAttribute('normal', new THREE.InterleavedBufferAttribute(small, 3, 8, true));
      geometry.setIndex(new THREE.BufferAttribute(piece.corners, 1));
      const middleOf = (kOrigin + kBrick / 2) * kPerVoxel;
      geometry.boundingSphere = new THREE.Sphere(new THREE.Vector3(middleOf, middleOf, middleOf), kBrick * kPerVoxel);
      const mesh = new THREE.Mesh(geometry, this.closingLook);
      mesh.scale.setScalar(voxel / kPerVoxel);
      mesh.position.fromArray(piece.brick.map((b, i) => origin[i] - middle[i] + (b * kBrick - kOrigin) * voxel));
      this.layers.closing.add(mesh);
      this.pieces.set(piece.key, mesh);
    }
    this.draw();
  }

  setProxy(mesh: Mesh | null): void {
    this.proxy.set(mesh);
    this.draw();
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
      const file = new ShownMesh(this.matcap, '#ffffff', { side: this.closingLook.side });
      this.files.push(file);
      this.scene.add(file.group);
      file.group.visible = false;
    }
    this.files[i].set(mesh);
    if (inner) this.inner.add(this.files[i]);
    this.dress();
  }
  styleFile(i: number, visible: boolean, color: string, opacity: number): void {
    const file = this.files[i];
    if (!file) return;
    file.group.visible = visible;
    file.looks[0].color.set(color);
    file.setOpacity(opacity);
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
    for (const look of [this.closingLook, ...[this.proxy, ...this.files].flatMap((shown) => shown.looks)]) {
      if (look.side !== side) look.needsUpdate = true;
      look.side = side;
    }
    this.draw();
  }

  show(shown: Record<Layer, boolean>): void {
    for (const layer of Object.keys(shown) as Layer[]) this.layers[layer].visible = shown[layer];
    this.proxy.setOpacity(shown.proxy && (shown.scene || shown.closing) ? 0.28 : 1);
    this.draw();
  }

  setBase(world: number): void {
    this.base = world;
    shared.uBase.value = (world / (this.drawnVoxel || this.facts.voxel)) * 16 || 1;
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

  /// Returns the visible point there, relative to the middle. Transparent meshes are ignored.
  pick(x: number, y: number): THREE.Vector3 | null {
    const hidden: THREE.Object3D[] = [this.stroke, this.ruler, this.ends, ...this.tools];
    for (const shown of [this.proxy, ...this.files]) hidden.push(shown.transparent ? shown.group : shown.edges);
    const fill = (depths: THREE.Material) => this.caps.draw(this.renderer, this.scene, this.camera, this.size, this.solids().filter((solid) => solid.opacity === 1), depths);
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
    const closing: Solid = { group: this.layers.closing, lines: [], color: this.closingLook.color, opacity: 1 };
    const of = (shown: ShownMesh): Solid[] => (shown.group.visible && shown.closed ? [shown.solid] : []);
    const [inner, outer] = [true, false].map((inside) => this.files.filter((file) => this.inner.has(file) === inside).flatMap(of));
    return [...outer, ...of(this.proxy), ...(this.layers.closing.visible ? [closing] : []), ...of(this.mesh), ...inner];
  }

  /// With a cut, what marks places is drawn last, and whole.
  private render(): void {
    const { renderer, scene, camera } = this;
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
