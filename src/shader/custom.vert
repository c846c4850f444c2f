#version 330

uniform mat4 u_model;
uniform mat4 u_view_projection;
uniform sampler2D u_texture_2;
uniform float u_height_scaling;

in vec3 in_position;
in vec3 in_normal;
in vec3 in_tangent;
in vec2 in_uv;

out vec3 v_position;
out vec3 v_normal;
out vec3 v_tangent;
out vec2 v_uv;

void main() {
    float height = textureLod(u_texture_2, in_uv, 0.0).r;
    vec3 displaced = in_position + in_normal * (height * u_height_scaling);
    v_position = (u_model * vec4(displaced, 1.0)).xyz;
    v_normal = normalize(mat3(u_model) * in_normal);
    v_tangent = normalize(mat3(u_model) * in_tangent);
    v_uv = in_uv;
    gl_Position = u_view_projection * vec4(v_position, 1.0);
}
