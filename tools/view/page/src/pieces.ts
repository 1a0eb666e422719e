// The closing's surface in the view. Its pieces change one by one.
import * as THREE from 'three';
import { surfaceMaterial } from './looks';
import { ShownLayer } from './shown';
import type { Piece, Surface } from './wire';

const kBrick = 64, kPerVoxel = 256, kOrigin = 8;  // lib/live/surface_piece.h
const kMiddle = (kOrigin + kBrick / 2) * kPerVoxel;

function geometryOf(piece: Piece): THREE.BufferGeometry {
  const geometry = new THREE.BufferGeometry();
  const words = new THREE.InterleavedBuffer(new Uint16Array(piece.bytes), 6), small = new THREE.InterleavedBuffer(new Int8Array(piece.bytes), 12);
  geometry.setAttribute('position', new THREE.InterleavedBufferAttribute(words, 3, 0));
  geometry.setAttribute('aValue', new THREE.InterleavedBufferAttribute(words, 1, 3));
  geometry.setAttribute('normal', new THREE.InterleavedBufferAttribute(small, 3, 8, true));
  geometry.setIndex(new THREE.BufferAttribute(piece.corners, 1));
  geometry.boundingSphere = new THREE.Sphere(new THREE.Vector3(kMiddle, kMiddle, kMiddle), kBrick * kPerVoxel);
  return geometry;
}

export class ShownPieces extends ShownLayer {
  readonly looks: THREE.MeshMatcapMaterial[];
  readonly edges: THREE.Object3D[] = [];
  readonly closed = true;
  voxel = 0;  // edge of the voxels of the pieces, scene units
  private pieces = new Map<string, THREE.Mesh>();

  constructor(matcap: THREE.Texture) {
    super();
    this.looks = [surfaceMaterial(matcap, '#d8d4cc', 'scale', { polygonOffset: true })];
  }

  get empty(): boolean { return this.pieces.size === 0; }

  private remove(key: string): void {
    const old = this.pieces.get(key);
    if (!old) return;
    old.geometry.dispose();
    this.group.remove(old);
    this.pieces.delete(key);
  }

  /// `middle`: of the scene, which lies at 0 in the view.
  set({ whole, voxel, origin, pieces }: Surface, middle: number[]): void {
    if (whole) [...this.pieces.keys()].forEach((key) => this.remove(key));
    this.voxel = voxel;
    for (const piece of pieces) {
      this.remove(piece.key);
      if (piece.vertices === 0) continue;
      const mesh = new THREE.Mesh(geometryOf(piece), this.looks[0]);
      mesh.scale.setScalar(voxel / kPerVoxel);
      mesh.position.fromArray(piece.brick.map((b, i) => origin[i] - middle[i] + (b * kBrick - kOrigin) * voxel));
      this.group.add(mesh);
      this.pieces.set(piece.key, mesh);
    }
    const bounds = (mesh: THREE.Mesh) => mesh.geometry.boundingSphere!.clone().applyMatrix4(mesh.matrix.compose(mesh.position, mesh.quaternion, mesh.scale));
    this.radius = Math.max(0, ...[...this.pieces.values()].map(bounds).map((sphere) => sphere.center.length() + sphere.radius));
  }
}
