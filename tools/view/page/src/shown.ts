// A mesh in the view, with its edges: the scene, the proxy or a file.
import * as THREE from 'three';
import type { Solid } from './caps';
import { isClosed } from './closed';
import { surfaceMaterial } from './looks';
import type { Mesh } from './wire';

function geometryOf(mesh: Mesh): THREE.BufferGeometry {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute('position', new THREE.BufferAttribute(mesh.positions, 3));
  if (mesh.normals) geometry.setAttribute('normal', new THREE.InterleavedBufferAttribute(new THREE.InterleavedBuffer(mesh.normals, 4), 3, 0, true));
  if (mesh.corners) geometry.setIndex(new THREE.BufferAttribute(mesh.corners, 1));
  return geometry;
}

export class ShownMesh {
  readonly group = new THREE.Group();
  readonly edges: THREE.LineSegments<THREE.BufferGeometry, THREE.LineBasicMaterial>;
  readonly looks: [plain: THREE.MeshMatcapMaterial, byDistance: THREE.MeshMatcapMaterial];
  farthest = 0;  // distance from the scene, scene units; 0: not known
  private surface: THREE.Mesh | null = null;
  private colored = false;
  private mesh: Mesh | null = null;
  private bounds: boolean | null = null;  // whether the mesh is closed; null: not known yet

  constructor(matcap: THREE.Texture, color: string, more: THREE.MeshMatcapMaterialParameters = {}) {
    const all = { polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1, ...more };
    this.looks = [surfaceMaterial(matcap, color, 'nothing', all), surfaceMaterial(matcap, '#ffffff', 'distance', all)];
    this.edges = new THREE.LineSegments(new THREE.BufferGeometry(), new THREE.LineBasicMaterial({ transparent: true, opacity: 0.75 }));
    this.edges.frustumCulled = false;
    this.group.add(this.edges);
  }

  set(mesh: Mesh | null): void {
    if (this.surface) {
      this.surface.geometry.dispose();
      this.group.remove(this.surface);
    }
    this.edges.geometry.dispose();
    this.edges.geometry = new THREE.BufferGeometry();
    this.surface = null;
    this.farthest = 0;
    this.mesh = mesh;
    this.bounds = null;
    if (!mesh) return;
    const geometry = geometryOf(mesh), flat = mesh.normals === null;
    for (const look of this.looks) {
      if (look.flatShading !== flat) look.needsUpdate = true;
      look.flatShading = flat;
    }
    if (mesh.distances) {
      geometry.setAttribute('aValue', new THREE.BufferAttribute(mesh.distances, 1));
      for (const d of mesh.distances) this.farthest = Math.max(this.farthest, d);
    }
    this.surface = new THREE.Mesh(geometry);
    this.colorByDistance(this.colored);
    this.group.add(this.surface);
    if (mesh.edges) {
      this.edges.geometry.setAttribute('position', geometry.getAttribute('position'));
      this.edges.geometry.setIndex(new THREE.BufferAttribute(mesh.edges, 1));
    }
  }

  /// Takes effect where distances are known.
  colorByDistance(on: boolean): void {
    this.colored = on;
    const colored = on && this.farthest > 0;
    if (this.surface) this.surface.material = this.looks[colored ? 1 : 0];
    this.edges.material.opacity = colored ? 0.3 : 0.75;
  }

  /// Returns whether the mesh bounds a solid. The first question about a mesh takes some time.
  get closed(): boolean { return this.bounds ??= this.mesh !== null && isClosed(this.mesh.positions, this.mesh.corners); }

  get solid(): Solid { return { group: this.group, lines: [this.edges], color: this.looks[0].color, opacity: this.looks[0].opacity }; }
  get transparent(): boolean { return this.looks[0].transparent; }
  /// An opacity below 1 shows what is behind.
  setOpacity(opacity: number): void {
    const through = opacity < 1;
    for (const look of this.looks) {
      look.opacity = opacity;
      look.depthWrite = !through;
      if (look.transparent !== through) look.needsUpdate = true;
      look.transparent = through;
    }
  }
}
