#version 330

uniform vec3 u_cam_pos;
uniform samplerCube u_texture_cubemap;

in vec3 v_position;
in vec3 v_normal;

out vec4 out_color;

void main() {
    vec3 n = normalize(v_normal);
    vec3 v = normalize(u_cam_pos - v_position);
    out_color = vec4(texture(u_texture_cubemap, reflect(-v, n)).rgb, 1.0);
}
