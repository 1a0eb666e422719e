// A layer of the view: a mesh with its edges, which is the scene, the proxy or a file; or the closing (pieces.ts).
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

/// From the outermost to the innermost.
const kNests = ['outer', 'proxy', 'closing', 'scene', 'inner'] as const;
export type Nest = (typeof kNests)[number];

export abstract class ShownLayer {
  readonly group = new THREE.Group();
  abstract readonly looks: THREE.MeshMatcapMaterial[];
  abstract readonly edges: THREE.Object3D[];
  abstract readonly empty: boolean;
  abstract readonly closed: boolean;  // whether it bounds a solid
  wanted = 1;  // the opacity beside other layers
  radius = 0;  // of a ball around the middle of the scene that holds it

  /// Inner layers are blended before those around them. The scene and what lies inside it are drawn farther back than what encloses them,
  /// by the slope of a pixel. Outer layers stay: a steep face that went back, too, would show a scene that faces the viewer.
  nest(nest: Nest): void {
    const order = kNests.indexOf(nest), behind = Math.max(0, order - kNests.indexOf('closing'));
    this.group.renderOrder = -1 - order;
    for (const look of this.looks) [look.polygonOffsetFactor, look.polygonOffsetUnits] = [behind, 4 * behind];
  }

  get opacity(): number { return this.looks[0].opacity; }
  get solid(): Solid { return { group: this.group, lines: this.edges, color: this.looks[0].color, opacity: this.opacity }; }
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

/// How the faces of proxy and files look.
export const kFaces = ['edges', 'flat', 'smooth'] as const;
export type Faces = (typeof kFaces)[number];

const kBefore = 0.998;  // edges are drawn at this share of their distance from the camera, and so before their surface
function edgeMaterial(): THREE.LineBasicMaterial {
  const material = new THREE.LineBasicMaterial({ transparent: true, opacity: 0.75 });
  material.onBeforeCompile = (shader) => {
    shader.vertexShader = shader.vertexShader.replace('#include <project_vertex>', `#include <project_vertex>
      gl_Position = projectionMatrix * vec4(mvPosition.xyz * ${kBefore}, 1.0);`);
  };
  return material;
}

export class ShownMesh extends ShownLayer {
  readonly edges: [THREE.LineSegments<THREE.BufferGeometry, THREE.LineBasicMaterial>];
  readonly looks: [plain: THREE.MeshMatcapMaterial, byDistance: THREE.MeshMatcapMaterial];
  farthest = 0;  // distance from the scene, scene units; 0: not known
  private surface: THREE.Mesh | null = null;
  private colored = false;
  private faces: Faces = 'edges';
  private mesh: Mesh | null = null;
  private bounds: boolean | null = null;  // whether the mesh is closed; null: not known yet

  constructor(matcap: THREE.Texture, color: string, more: THREE.MeshMatcapMaterialParameters = {}) {
    super();
    const all = { polygonOffset: true, ...more };
    this.looks = [surfaceMaterial(matcap, color, 'nothing', all), surfaceMaterial(matcap, '#ffffff', 'distance', all)];
    this.edges = [new THREE.LineSegments(new THREE.BufferGeometry(), edgeMaterial())];
    this.edges[0].frustumCulled = false;
    this.group.add(this.edges[0]);
  }
  get empty(): boolean { return this.surface === null; }

  set(mesh: Mesh | null): void {
    if (this.surface) {
      this.surface.geometry.dispose();
      this.group.remove(this.surface);
    }
    const [edges] = this.edges;
    edges.geometry.dispose();
    edges.geometry = new THREE.BufferGeometry();
    this.surface = null;
    this.farthest = this.radius = 0;
    this.mesh = mesh;
    this.bounds = null;
    if (!mesh) return;
    for (let i = 0, p = mesh.positions; i < p.length; i += 3) this.radius = Math.max(this.radius, Math.hypot(p[i], p[i + 1], p[i + 2]));
    const geometry = geometryOf(mesh);
    if (mesh.distances) {
      geometry.setAttribute('aValue', new THREE.BufferAttribute(mesh.distances, 1));
      for (const d of mesh.distances) this.farthest = Math.max(this.farthest, d);
    }
    this.surface = new THREE.Mesh(geometry);
    this.colorByDistance(this.colored);
    this.setFaces(this.faces);
    this.group.add(this.surface);
    if (mesh.edges) {
      edges.geometry.setAttribute('position', geometry.getAttribute('position'));
      edges.geometry.setIndex(new THREE.BufferAttribute(mesh.edges, 1));
    }
  }

  /// A mesh that comes with normals is always smooth.
  setFaces(faces: Faces): void {
    this.faces = faces;
    this.edges[0].visible = faces === 'edges';
    const flat = this.mesh?.normals === null && faces !== 'smooth';
    if (!flat && this.surface && !this.surface.geometry.hasAttribute('normal')) this.surface.geometry.computeVertexNormals();
    for (const look of this.looks) {
      if (look.flatShading !== flat) look.needsUpdate = true;
      look.flatShading = flat;
    }
  }

  /// Takes effect where distances are known.
  colorByDistance(on: boolean): void {
    this.colored = on;
    const colored = on && this.farthest > 0;
    if (this.surface) this.surface.material = this.looks[colored ? 1 : 0];
    this.edges[0].material.opacity = colored ? 0.3 : 0.75;
  }

  /// Returns whether the mesh bounds a solid. The first question about a mesh takes some time.
  get closed(): boolean { return this.bounds ??= this.mesh !== null && isClosed(this.mesh.positions, this.mesh.corners); }
}
