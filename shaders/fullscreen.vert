#version 460
layout(location = 0) out vec2 ndc;
// One triangle that covers the screen, at the far plane (reversed depth: 0).
void main() {
  ndc = vec2(gl_VertexIndex == 1 ? 3.0 : -1.0, gl_VertexIndex == 2 ? 3.0 : -1.0);
  gl_Position = vec4(ndc, 0.0, 1.0);
}
