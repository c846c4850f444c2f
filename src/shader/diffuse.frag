#version 330

uniform vec3 u_color;
uniform vec3 u_light_pos;
uniform vec3 u_light_intensity;
uniform float u_kd;

in vec3 v_position;
in vec3 v_normal;

out vec4 out_color;

void main() {
    vec3 n = normalize(v_normal);
    vec3 to_light = u_light_pos - v_position;
    float r2 = dot(to_light, to_light);
    vec3 l = normalize(to_light);
    vec3 irradiance = u_light_intensity * (1.0 / r2);
    out_color = vec4(u_color * irradiance * (u_kd * max(0.0, dot(n, l))), 1.0);
}
