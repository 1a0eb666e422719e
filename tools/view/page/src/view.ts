// Draws scene, closing and proxy around the middle of the scene, in scene units.
import * as THREE from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import type { State, Vec3 } from './api';
import { makeMatcap, shared, surfaceMaterial } from './looks';
import { Picker } from './picker';
import type { Mesh, Piece } from './wire';

export type Layer = 'scene' | 'closing' | 'proxy';
const kBrick = 64, kPerVoxel = 256, kOrigin = 8;  // lib/live/surface_piece.h

export class View {
  readonly camera = new THREE.PerspectiveCamera(35, 1, 1, 10);
  readonly controls: OrbitControls;
  private renderer: THREE.WebGLRenderer;
  private scene = new THREE.Scene();
  private layers = { scene: new THREE.Group(), closing: new THREE.Group(), proxy: new THREE.Group() };
  private edges = new THREE.LineSegments(new THREE.BufferGeometry(), new THREE.LineBasicMaterial({ transparent: true, opacity: 0.75 }));
  private stroke = new THREE.Line(new THREE.BufferGeometry(), new THREE.LineBasicMaterial({ color: '#ffffff', depthTest: false, transparent: true }));
  private matcap = makeMatcap();
  private closingLook = surfaceMaterial(this.matcap, '#d8d4cc', true);
  private sceneLook = surfaceMaterial(this.matcap, '#c9d1dc', false, { side: THREE.DoubleSide });
  private proxyLook = surfaceMaterial(this.matcap, '#9fd0b4', false, { flatShading: true, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1 });
  private pieces = new Map<string, THREE.Mesh>();
  private picker: Picker;
  private size = 1;
  private due = false;
  private facts!: State['scene'];
  frames = 0;

  constructor(private canvas: HTMLCanvasElement) {
    this.renderer = new THREE.WebGLRenderer({ canvas, antialias: true, alpha: false });
    this.picker = new Picker(this.renderer, this.scene);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.zoomToCursor = true;
    this.controls.addEventListener('change', () => this.draw());
    this.stroke.renderOrder = 2;
    this.stroke.frustumCulled = this.edges.frustumCulled = false;
    this.layers.proxy.add(this.edges);
    this.scene.add(this.layers.scene, this.layers.closing, this.layers.proxy, this.stroke);
    const dark = matchMedia('(prefers-color-scheme: dark)');
    const dress = () => {
      this.scene.background = new THREE.Color(dark.matches ? '#1b1f25' : '#e4e8ee');
      this.edges.material.color.set(dark.matches ? '#0c2b1c' : '#123c28');
      this.draw();
    };
    dark.addEventListener('change', dress);
    dress();
    new ResizeObserver(() => this.resize()).observe(canvas);
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
    const up = this.camera.up, half = new THREE.Vector3().subVectors(new THREE.Vector3(...this.facts.max), new THREE.Vector3(...this.facts.min)).multiplyScalar(0.5);
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
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute('position', new THREE.BufferAttribute(mesh.positions, 3));
    const normals = new THREE.InterleavedBuffer(mesh.normals!, 4);
    geometry.setAttribute('normal', new THREE.InterleavedBufferAttribute(normals, 3, 0, true));
    this.layers.scene.add(new THREE.Mesh(geometry, this.sceneLook));
    this.draw();
  }

  setPieces(pieces: Piece[]): void {
    const { voxel, origin, middle } = this.facts;
    for (const piece of pieces) {
      const old = this.pieces.get(piece.key);
      if (old) {
        old.geometry.dispose();
        this.layers.closing.remove(old);
        this.pieces.delete(piece.key);
      }
      if (piece.vertices === 0) continue;
      const geometry = new THREE.BufferGeometry();
      const words = new THREE.InterleavedBuffer(new Uint16Array(piece.bytes), 6), small = new THREE.InterleavedBuffer(new Int8Array(piece.bytes), 12);
      geometry.setAttribute('position', new THREE.InterleavedBufferAttribute(words, 3, 0));
      geometry.setAttribute('aScale', new THREE.InterleavedBufferAttribute(words, 1, 3));
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
    this.layers.proxy.children.filter((child): child is THREE.Mesh => child instanceof THREE.Mesh).forEach((child) => {
      child.geometry.dispose();
      this.layers.proxy.remove(child);
    });
    this.edges.geometry.dispose();
    this.edges.geometry = new THREE.BufferGeometry();
    if (mesh) {
      const geometry = new THREE.BufferGeometry();
      geometry.setAttribute('position', new THREE.BufferAttribute(mesh.positions, 3));
      geometry.setIndex(new THREE.BufferAttribute(mesh.corners!, 1));
      this.layers.proxy.add(new THREE.Mesh(geometry, this.proxyLook));
      this.edges.geometry = new THREE.WireframeGeometry(geometry);
    }
    this.draw();
  }

  show(shown: Record<Layer, boolean>): void {
    for (const layer of Object.keys(shown) as Layer[]) this.layers[layer].visible = shown[layer];
    const through = shown.proxy && (shown.scene || shown.closing);
    this.proxyLook.transparent = through;
    this.proxyLook.opacity = through ? 0.28 : 1;
    this.proxyLook.depthWrite = !through;
    this.proxyLook.needsUpdate = true;
    this.draw();
  }

  setBase(world: number): void {
    shared.uBase.value = (world / this.facts.voxel) * 16 || 1;
    this.draw();
  }

  /// Places the brush: scene units, relative to the middle; null: no brush.
  setBrush(at: THREE.Vector3 | null, radius: number, color: string): void {
    shared.uBrush.value.set(at?.x ?? 0, at?.y ?? 0, at?.z ?? 0, at ? radius : 0);
    shared.uBrushColor.value.set(color);
    this.draw();
  }

  setStroke(points: THREE.Vector3[]): void {
    this.stroke.geometry.dispose();
    this.stroke.geometry = new THREE.BufferGeometry().setFromPoints(points);
    this.stroke.visible = points.length > 1;
    this.draw();
  }

  /// Returns the visible point there, relative to the middle. A transparent proxy is ignored.
  pick(x: number, y: number): THREE.Vector3 | null {
    const hidden: THREE.Object3D[] = [this.edges, this.stroke];
    if (this.proxyLook.transparent) hidden.push(this.layers.proxy);
    return this.picker.pick(this.camera, x, y, this.canvas.clientWidth, this.canvas.clientHeight, hidden);
  }

  toScene(p: THREE.Vector3): Vec3 {
    const m = this.facts.middle;
    return [p.x + m[0], p.y + m[1], p.z + m[2]];
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

  draw(): void {
    if (this.due) return;
    this.due = true;
    requestAnimationFrame(() => {
      this.due = false;
      if (this.facts) this.frames++;
      this.renderer.render(this.scene, this.camera);
    });
  }
}
