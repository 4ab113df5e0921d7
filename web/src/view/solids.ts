// Balls, ellipsoids and rods that stand for the parts and for where they touch.
import {
  CylinderGeometry,
  GLSL3,
  InstancedBufferAttribute,
  InstancedMesh,
  Matrix4,
  Quaternion,
  RawShaderMaterial,
  SphereGeometry,
  Vector3,
  type BufferGeometry,
} from 'three';
import { kLightGlsl } from './part_table';

const kVertex = /* glsl */ `
precision highp float;
uniform mat4 modelViewMatrix;
uniform mat4 projectionMatrix;
uniform mat3 normalMatrix;
in vec3 position;
in vec3 normal;
in mat4 instanceMatrix;
in vec4 tint;  // colour and id
out vec3 vNormal;
flat out vec4 vTint;
void main() {
  mat3 linear = mat3(instanceMatrix);
  // Normals of a scaled shape: the axes of an instance are perpendicular.
  vec3 squares = vec3(dot(linear[0], linear[0]), dot(linear[1], linear[1]),
                      dot(linear[2], linear[2]));
  vNormal = normalMatrix * (linear * (normal / squares));
  vTint = tint;
  gl_Position = projectionMatrix * modelViewMatrix * instanceMatrix * vec4(position, 1.0);
}
`;

const kFragment = /* glsl */ `
precision highp float;
in vec3 vNormal;
flat in vec4 vTint;
out vec4 color;
${kLightGlsl}
void main() { color = vec4(lit(vTint.rgb, normalize(vNormal)), vTint.a); }
`;

/** One ball, ellipsoid or rod. */
export interface Solid {
  matrix: Matrix4;
  color: readonly number[];
  /** As PartLook.id. */
  id: number;
}

/** Many copies of one form; as many as are set. */
export class Solids {
  readonly object: InstancedMesh;
  private readonly material: RawShaderMaterial;

  constructor(geometry: BufferGeometry, most: number) {
    this.material = new RawShaderMaterial({
      glslVersion: GLSL3,
      vertexShader: kVertex,
      fragmentShader: kFragment,
    });
    this.object = new InstancedMesh(geometry, this.material, Math.max(1, most));
    this.object.frustumCulled = false;
    geometry.setAttribute(
      'tint',
      new InstancedBufferAttribute(new Float32Array(4 * Math.max(1, most)), 4),
    );
  }

  set(solids: readonly Solid[]): void {
    const tint = this.object.geometry.getAttribute('tint') as InstancedBufferAttribute;
    this.object.count = solids.length;
    if (solids.length === 0) return; // nothing to send
    solids.forEach((solid, i) => {
      this.object.setMatrixAt(i, solid.matrix);
      tint.setXYZW(i, solid.color[0], solid.color[1], solid.color[2], solid.id / 255);
    });
    this.object.instanceMatrix.needsUpdate = true;
    tint.needsUpdate = true;
  }

  dispose(): void {
    this.object.geometry.dispose();
    this.object.dispose();
    this.material.dispose();
  }
}

export const sphereGeometry = () => new SphereGeometry(1, 32, 20);

/** From z = 0 to z = 1, radius 1, open ends. */
export const rodGeometry = () =>
  new CylinderGeometry(1, 1, 1, 16, 1, true).rotateX(Math.PI / 2).translate(0, 0, 0.5);

/** A rod between two points. */
export function rodMatrix(a: Vector3, b: Vector3, radius: number): Matrix4 {
  const along = b.clone().sub(a);
  const length = along.length();
  const turn = new Quaternion().setFromUnitVectors(
    new Vector3(0, 0, 1),
    length > 0 ? along.divideScalar(length) : new Vector3(0, 0, 1),
  );
  return new Matrix4().compose(a, turn, new Vector3(radius, radius, length));
}
