// SPDX-License-Identifier: GPL-3.0-or-later
// Spheres and sticks as quads whose fragments find the true surface (impostors: Tarini, Cignoni and Montani 2006), seen with perspective
// from the eye in the origin or, where `parallel` is set, along -z.

export const sphereVertex = `
precision highp float;
uniform mat4 modelViewMatrix;
uniform mat4 projectionMatrix;
uniform bool parallel;
uniform float scale;
in vec3 centre;
in float radius;
in vec3 tint;
in float mark;
out vec3 point;
flat out vec3 middle;
flat out float size;
flat out vec3 paint;
flat out float marked;
void main() {
  vec2 corner = vec2(2 * (gl_VertexID & 1) - 1, (gl_VertexID & 2) - 1);
  middle = (modelViewMatrix * vec4(centre, 1.0)).xyz;
  size = radius * scale;
  paint = tint;
  marked = mark;
  if (parallel) {
    point = middle + vec3(corner * size, size);
    gl_Position = projectionMatrix * vec4(point, 1.0);
    return;
  }
  float distance = length(middle);
  if (distance <= 1.001 * size) {  // the eye is inside
    gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
    return;
  }
  // In front of the sphere, as wide as the cone that touches it.
  vec3 toEye = -middle / distance;
  vec3 across = normalize(cross(vec3(0.0, 1.0, 0.001), toEye));
  vec3 up = cross(toEye, across);
  float halfWidth = (distance - size) * size / sqrt(distance * distance - size * size);
  point = middle + toEye * size + halfWidth * (corner.x * across + corner.y * up);
  gl_Position = projectionMatrix * vec4(point, 1.0);
}`;

const lighting = `
vec3 lit(vec3 base, vec3 normal, vec3 direction) {
  vec3 light = normalize(vec3(-0.45, 0.65, 0.75));
  float diffuse = 0.5 + 0.5 * dot(normal, light);
  float facing = max(dot(normal, -direction), 0.0);
  float gloss = pow(max(dot(reflect(-light, normal), -direction), 0.0), 24.0);
  return base * (0.38 + 0.88 * diffuse * diffuse) * (0.5 + 0.5 * smoothstep(0.0, 0.5, facing)) + 0.14 * gloss;
}
vec3 hazy(vec3 base, float depth) {
  return mix(base, haze, 0.4 * smoothstep(hazeRange.x, hazeRange.y, depth));
}`;

// The quad lies in front of its sphere: a fragment behind what is drawn already can be left out before it is computed.
export const sphereFragment = `
#ifdef GL_EXT_conservative_depth
#extension GL_EXT_conservative_depth : enable
#endif
precision highp float;
uniform mat4 projectionMatrix;
uniform bool parallel;
uniform vec4 slab;       // unit normal in the space of the eye; w: whether there is a slab
uniform vec2 slabRange;  // along the normal
uniform vec3 haze;
uniform vec2 hazeRange;
in vec3 point;
flat in vec3 middle;
flat in float size;
flat in vec3 paint;
flat in float marked;
out vec4 colour;
#ifdef GL_EXT_conservative_depth
layout(depth_greater) out highp float gl_FragDepth;
#endif
${lighting}
void main() {
  vec3 origin = parallel ? vec3(point.xy, 0.0) : vec3(0.0);
  vec3 direction = parallel ? vec3(0.0, 0.0, -1.0) : normalize(point);
  float along = dot(direction, middle - origin);
  vec3 nearest = origin + along * direction - middle;
  float inside = size * size - dot(nearest, nearest);
  if (inside < 0.0) discard;
  float half_chord = sqrt(inside);
  float enter = along - half_chord;
  float leave = along + half_chord;
  bool cut = false;
  if (slab.w > 0.5) {
    float slope = dot(slab.xyz, direction);
    vec2 crossing = (slabRange - dot(slab.xyz, origin)) / (abs(slope) > 1e-6 ? slope : 1e-6);
    float first = min(crossing.x, crossing.y);
    cut = first > enter;
    enter = max(enter, first);
    leave = min(leave, max(crossing.x, crossing.y));
    if (enter > leave) discard;
  }
  vec3 hit = origin + enter * direction;
  vec3 normal = (hit - middle) / size;
  vec4 clip = projectionMatrix * vec4(hit, 1.0);
  gl_FragDepth = 0.5 * clip.z / clip.w + 0.5;
#ifdef TRANSLUCENT
  float rim = 1.0 - abs(dot(normal, direction));
  colour = vec4(hazy(paint, -hit.z), cut ? 0.5 : 0.22 + 0.55 * rim * rim);
#else
  // A cut face has the very colour of the legend, without light and haze.
  vec3 shade = cut ? paint * (length(hit - middle) > 0.93 * size ? 0.7 : 1.0) : hazy(lit(paint, normal, direction), -hit.z);
  if (marked > 0.5) {
    float rim = smoothstep(0.35, 0.75, 1.0 - abs(dot(normal, direction)));
    shade = mix(shade, marked > 1.5 ? vec3(1.0, 0.83, 0.1) : vec3(1.0), marked > 1.5 ? 0.35 + 0.65 * rim : rim);
  }
  colour = vec4(shade, 1.0);
#endif
}`;

export const stickVertex = `
precision highp float;
uniform mat4 modelViewMatrix;
uniform mat4 projectionMatrix;
uniform bool parallel;
uniform float scale;
in vec3 start;
in vec3 branch;
in float width;
in float taper;  // 1: a cone that ends in a point
in vec3 tint;
out vec3 point;
out float across;
flat out vec3 side;
flat out vec3 outward;
flat out vec3 paint;
void main() {
  vec2 corner = vec2(2 * (gl_VertexID & 1) - 1, (gl_VertexID & 2) - 1);
  vec3 from = (modelViewMatrix * vec4(start, 1.0)).xyz;
  vec3 to = (modelViewMatrix * vec4(start + branch, 1.0)).xyz;
  vec3 axis = normalize(to - from);
  vec3 toEye = parallel ? vec3(0.0, 0.0, 1.0) : normalize(-0.5 * (from + to));
  side = normalize(cross(axis, toEye));
  outward = cross(side, axis);
  across = corner.x;
  paint = tint;
  point = mix(from, to, 0.5 + 0.5 * corner.y) + side * corner.x * width * scale * (corner.y > 0.0 ? 1.0 - taper : 1.0);
  gl_Position = projectionMatrix * vec4(point, 1.0);
}`;

export const stickFragment = `
precision highp float;
uniform bool parallel;
uniform vec4 slab;
uniform vec2 slabRange;
uniform vec3 haze;
uniform vec2 hazeRange;
in vec3 point;
in float across;
flat in vec3 side;
flat in vec3 outward;
flat in vec3 paint;
out vec4 colour;
${lighting}
void main() {
  if (slab.w > 0.5) {
    float place = dot(slab.xyz, point);
    if (place < slabRange.x || place > slabRange.y) discard;
  }
  vec3 normal = side * across + outward * sqrt(max(0.0, 1.0 - across * across));
  colour = vec4(hazy(lit(paint, normal, parallel ? vec3(0.0, 0.0, -1.0) : normalize(point)), -point.z), 1.0);
}`;
