"""The picture as OpenGL computes it, step for step what `cpu.draw` does."""

from __future__ import annotations

from typing import NamedTuple

from paintlink.color.display import LUMINANCE, SHOULDER_FROM
from paintlink.preview.cpu import TOLERANCE, TOO_BRIGHT, TOO_CHROMATIC


class Shape(NamedTuple):
    """What a program is compiled for: a driver is twice as fast with fixed loops.

    Parameters
    ----------
    channels
        1 in neutral light, else 3.
    held, used
        Layers of four terms a channel has in the texture, and how many of them the
        paints need.
    """

    channels: int
    held: int
    used: int
    paints: int


VERTEX = """
#version 330
void main() {
    vec2 corner = vec2((gl_VertexID << 1) & 2, gl_VertexID & 2);
    gl_Position = vec4(2.0 * corner - 1.0, 0.0, 1.0);
}
"""

HEADER = """
#version 330
const int CHANNELS = {channels};
const int HELD = {held};
const int USED = {used};
const int PAINTS = {paints};
"""

FRAGMENT = f"""
uniform sampler2DArray planes;
uniform vec4 inks[3 * PAINTS * USED];
out vec4 encoded;

const vec3 LUMINANCE = vec3({", ".join(map(str, LUMINANCE))});
const float SHOULDER = {SHOULDER_FROM};
const float ROOM = 1.0 - SHOULDER;
const float TOLERANCE = {TOLERANCE};

vec4 plane(int layer) {{
    return texelFetch(planes, ivec3(gl_FragCoord.xy, layer), 0);
}}

float weighed(int channel, int first) {{
    float sum = 0.0;
    for (int layer = 0; layer < USED; ++layer) {{
        int from = CHANNELS == 1 ? layer : channel * HELD + layer;
        sum += dot(plane(from), inks[first + 3 * layer + channel]);
    }}
    return sum;
}}

vec3 paint(int part) {{
    int first = PAINTS == 1 ? 0 : 3 * USED * part;
    return vec3(weighed(0, first), weighed(1, first), weighed(2, first));
}}

vec3 desaturated(vec3 rgb, float lowest) {{
    if (lowest >= 0.0)
        return rgb;
    float luminance = dot(rgb, LUMINANCE);
    float keep = clamp(luminance / max(luminance - lowest, 1e-9), 0.0, 1.0);
    return luminance + keep * (rgb - luminance);
}}

vec3 shouldered(vec3 rgb, float peak) {{
    if (peak > SHOULDER)
        rgb *= (SHOULDER + ROOM * (1.0 - exp((SHOULDER - peak) / ROOM))) / peak;
    return clamp(rgb, 0.0, 1.0);
}}

vec3 encode(vec3 linear) {{
    vec3 curve = 1.055 * pow(linear, vec3(1.0 / 2.4)) - 0.055;
    return mix(curve, 12.92 * linear, lessThanEqual(linear, vec3(0.0031308)));
}}

void main() {{
    vec4 frame = plane(CHANNELS * HELD);
    vec3 seen = mix(vec3(frame.g), paint(int(frame.a)), frame.r);
    float lowest = min(seen.r, min(seen.g, seen.b));
    vec3 kept = desaturated(seen, lowest);
    float peak = max(kept.r, max(kept.g, kept.b));
    float flags = (lowest < -TOLERANCE ? {TOO_CHROMATIC}.0 : 0.0)
        + (peak > 1.0 + TOLERANCE ? {TOO_BRIGHT}.0 : 0.0);
    vec3 codes = encode(shouldered(kept, peak)) + frame.b / 255.0;
    encoded = vec4(codes, flags / 255.0);
}}
"""
