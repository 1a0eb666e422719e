// How surfaces look: a matcap, colours by scale, and the brush drawn onto them.
import * as THREE from 'three';

/// Uniforms that all materials share.
export const shared = {
  uBrush: { value: new THREE.Vector4(0, 0, 0, 0) },  // centre, relative to the middle of the scene, and radius; 0: none
  uBrushColor: { value: new THREE.Color('#2463c9') },
  uBase: { value: 1 },       // scale everywhere, 1/16 voxel
  uByScale: { value: 1 },    // 1: coloured by scale
  uFarthest: { value: 0 },   // distance from the scene with the last colour; 0: not coloured by distance
  uCut: { value: 0 },        // 1: back faces have a colour of their own, since a plane cuts surfaces open
};

/// A lit ball as a picture: warm light from the upper left, cool light from below, and a rim.
export function makeMatcap(): THREE.DataTexture {
  const n = 256, data = new Uint8Array(n * n * 4);
  const unit = (v: number[]) => v.map((x) => x / Math.hypot(...v));
  const key = unit([-0.45, 0.7, 0.62]), fill = unit([0.75, -0.25, 0.5]);
  for (let j = 0; j < n; ++j) {
    for (let i = 0; i < n; ++i) {
      let x = (2 * i + 1) / n - 1, y = (2 * j + 1) / n - 1;
      const r = Math.hypot(x, y);
      if (r > 0.999) { x *= 0.999 / r; y *= 0.999 / r; }
      const z = Math.sqrt(1 - x * x - y * y);
      const lit = (l: number[]) => Math.max(0, l[0] * x + l[1] * y + l[2] * z);
      const shine = Math.pow(Math.max(0, 2 * lit(key) * z - key[2]), 24) * 0.1, rim = Math.pow(1 - z, 4) * 0.16;
      const base = 0.36 + 0.09 * y, k = 0.6 * lit(key), f = 0.18 * lit(fill);
      const rgb = [base + k * 1.02 + f * 0.85 + shine + rim, base + k + f * 0.95 + shine + rim, base * 1.06 + k * 0.95 + f * 1.1 + shine + rim * 1.1];
      rgb.forEach((c, at) => { data[(j * n + i) * 4 + at] = Math.min(255, Math.round(255 * Math.max(0, c))); });
      data[(j * n + i) * 4 + 3] = 255;
    }
  }
  const texture = new THREE.DataTexture(data, n, n);
  texture.colorSpace = THREE.SRGBColorSpace;
  texture.magFilter = texture.minFilter = THREE.LinearFilter;
  texture.needsUpdate = true;
  return texture;
}

/// The attribute of a geometry by which a material colours it.
/// 'section': the face of a cut, which is hatched.
export type ColoredBy = 'nothing' | 'scale' | 'distance' | 'section';

/// Colours of distances from the scene, from 0 to the farthest; page.css has the same.
const kRamp = ['#4a74c9', '#45b5a4', '#ecd860', '#e8803a', '#b3245f'];
const ramp = kRamp.map((text) => { const c = new THREE.Color(text); return `vec3(${[c.r, c.g, c.b].map((x) => x.toFixed(4)).join(', ')})`; });

/// A matcap material that shows the brush, and colours by `aValue` of the geometry.
export function surfaceMaterial(matcap: THREE.Texture, color: string, by: ColoredBy, more: THREE.MeshMatcapMaterialParameters = {}): THREE.MeshMatcapMaterial {
  const material = new THREE.MeshMatcapMaterial({ matcap, color, ...more });
  const valued = by === 'scale' || by === 'distance', section = by === 'section';
  material.onBeforeCompile = (shader) => {
    Object.assign(shader.uniforms, shared);
    shader.vertexShader = shader.vertexShader
      .replace('#include <common>', `#include <common>\n${valued ? 'attribute float aValue; varying float vValue;' : ''} varying vec3 vPlace;`)
      .replace('#include <begin_vertex>', `#include <begin_vertex>\nvPlace = (modelMatrix * vec4(position, 1.0)).xyz; ${valued ? 'vValue = aValue;' : ''}`);
    shader.fragmentShader = shader.fragmentShader
      .replace('#include <common>', `#include <common>
        uniform vec4 uBrush; uniform vec3 uBrushColor; uniform float uBase, uByScale, uCut, uFarthest; varying vec3 vPlace; ${valued ? 'varying float vValue;' : ''}`)
      .replace('#include <color_fragment>', `#include <color_fragment>
        ${by === 'scale' ? `
        float octaves = clamp(log2(max(vValue, 0.5) / uBase) / 3.0, -1.0, 1.0) * uByScale;
        vec3 tint = octaves < 0.0 ? vec3(0.03, 0.16, 0.66) : vec3(0.70, 0.165, 0.013);
        diffuseColor.rgb = mix(diffuseColor.rgb, tint * 1.5, 0.85 * sqrt(abs(octaves)));` : ''}
        ${by === 'distance' ? `
        float share = clamp(vValue / uFarthest, 0.0, 1.0) * 4.0;
        diffuseColor.rgb = share < 1.0 ? mix(${ramp[0]}, ${ramp[1]}, share) : share < 2.0 ? mix(${ramp[1]}, ${ramp[2]}, share - 1.0)
          : share < 3.0 ? mix(${ramp[2]}, ${ramp[3]}, share - 2.0) : mix(${ramp[3]}, ${ramp[4]}, share - 3.0);
        diffuseColor.rgb *= 1.3;` : ''}
        ${section ? 'if (mod(gl_FragCoord.x + gl_FragCoord.y, 9.0) < 1.5) diffuseColor.rgb *= 0.6;' : 'if (uCut > 0.5 && !gl_FrontFacing) diffuseColor.rgb = vec3(0.52, 0.05, 0.075);'}
        if (uBrush.w > 0.0) {
          float d = distance(vPlace, uBrush.xyz) / uBrush.w, w = fwidth(d) + 1e-5;
          float ring = 1.0 - smoothstep(w, 2.2 * w, abs(d - 1.0));
          diffuseColor.rgb = mix(diffuseColor.rgb, uBrushColor, max(0.9 * ring, d < 1.0 ? 0.22 : 0.0));
        }`);
  };
  material.customProgramCacheKey = () => `surface ${by}`;
  return material;
}
