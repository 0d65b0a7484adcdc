#version 460
layout(location = 0) flat in vec3 luminance;
layout(location = 0) out vec4 result;

void main() { result = vec4(luminance, 0.0); }
