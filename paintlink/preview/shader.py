"""The picture as OpenGL computes it, step for step what `cpu.draw` does."""

from __future__ import annotations

from paintlink.color.display import LUMINANCE, SHOULDER_FROM
from paintlink.preview.strips import MOST

MAX_LAYERS = 4
"""Four terms each: twelve of the base and up to four coats."""

VERTEX = """
#version 330
void main() {
    vec2 corner = vec2((gl_VertexID << 1) & 2, gl_VertexID & 2);
    gl_Position = vec4(2.0 * corner - 1.0, 0.0, 1.0);
}
"""

FRAGMENT = f"""
#version 330
uniform sampler2DArray planes;
uniform vec4 inks[{3 * MOST * MAX_LAYERS}];
uniform ivec3 edges;
uniform float half_seam;
uniform int layers;
uniform int channels;
out vec4 encoded;

const vec3 LUMINANCE = vec3({", ".join(map(str, LUMINANCE))});
const float SHOULDER = {SHOULDER_FROM};
const float ROOM = 1.0 - SHOULDER;

vec4 plane(int layer) {{
    return texelFetch(planes, ivec3(gl_FragCoord.xy, layer), 0);
}}

vec3 paint() {{
    bvec3 passed = greaterThanEqual(ivec3(gl_FragCoord.x), edges);
    int first = 3 * layers * int(dot(vec3(passed), vec3(1.0)));
    vec3 sum = vec3(0.0);
    for (int layer = 0; layer < layers; ++layer) {{
        vec4 red = plane(layer);
        vec4 green = channels == 1 ? red : plane(layers + layer);
        vec4 blue = channels == 1 ? red : plane(2 * layers + layer);
        int ink = first + 3 * layer;
        sum += vec3(
            dot(red, inks[ink]), dot(green, inks[ink + 1]), dot(blue, inks[ink + 2])
        );
    }}
    return sum;
}}

float between_seams() {{
    vec3 beyond = abs(gl_FragCoord.x - vec3(edges)) - half_seam + 0.5;
    vec3 share = clamp(beyond, 0.0, 1.0);
    return share.x * share.y * share.z;
}}

vec3 into_gamut(vec3 rgb) {{
    float luminance = dot(rgb, LUMINANCE);
    float lowest = min(rgb.r, min(rgb.g, rgb.b));
    if (lowest < 0.0) {{
        float keep = clamp(luminance / max(luminance - lowest, 1e-9), 0.0, 1.0);
        rgb = luminance + keep * (rgb - luminance);
    }}
    float peak = max(rgb.r, max(rgb.g, rgb.b));
    if (peak > SHOULDER)
        rgb *= (SHOULDER + ROOM * (1.0 - exp((SHOULDER - peak) / ROOM))) / peak;
    return clamp(rgb, 0.0, 1.0);
}}

vec3 encode(vec3 linear) {{
    vec3 curve = 1.055 * pow(linear, vec3(1.0 / 2.4)) - 0.055;
    return mix(curve, 12.92 * linear, lessThanEqual(linear, vec3(0.0031308)));
}}

void main() {{
    vec4 frame = plane(channels * layers);
    vec3 seen = mix(vec3(frame.g), paint(), frame.r * between_seams());
    encoded = vec4(encode(into_gamut(seen)) + frame.b / 255.0, 1.0);
}}
"""
