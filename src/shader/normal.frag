#version 330

in vec3 v_normal;

out vec4 out_color;

void main() {
    vec3 n = normalize(v_normal);
    out_color = vec4((n + vec3(1.0)) * 0.5, 1.0);
}
