// A mesh in the view, with its edges: the scene, the proxy or a file.
import * as THREE from 'three';
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
  readonly look: THREE.MeshMatcapMaterial;
  private surface: THREE.Mesh | null = null;

  constructor(matcap: THREE.Texture, color: string, more: THREE.MeshMatcapMaterialParameters = {}) {
    this.look = surfaceMaterial(matcap, color, false, { polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1, ...more });
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
    if (!mesh) return;
    const geometry = geometryOf(mesh), flat = mesh.normals === null;
    if (this.look.flatShading !== flat) {
      this.look.flatShading = flat;
      this.look.needsUpdate = true;
    }
    this.surface = new THREE.Mesh(geometry, this.look);
    this.group.add(this.surface);
    if (mesh.edges) {
      this.edges.geometry.setAttribute('position', geometry.getAttribute('position'));
      this.edges.geometry.setIndex(new THREE.BufferAttribute(mesh.edges, 1));
    }
  }

  /// An opacity below 1 shows what is behind.
  setOpacity(opacity: number): void {
    const through = opacity < 1;
    this.look.opacity = opacity;
    this.look.depthWrite = !through;
    if (this.look.transparent !== through) {
      this.look.transparent = through;
      this.look.needsUpdate = true;
    }
  }
}
