#version 330

uniform vec3 u_cam_pos;
uniform vec3 u_color;
uniform vec3 u_light_pos;
uniform vec3 u_light_intensity;
uniform float u_ka;
uniform float u_kd;
uniform float u_ks;
uniform float u_shininess;
uniform sampler2D u_texture_2;
uniform vec2 u_texture_2_size;
uniform float u_normal_scaling;
uniform float u_height_scaling;
uniform float u_bitangent;
uniform float u_two_sided;

in vec3 v_position;
in vec3 v_normal;
in vec3 v_tangent;
in vec2 v_uv;

out vec4 out_color;

float h(vec2 uv) {
    return texture(u_texture_2, uv).r;
}

// Away from the camera the other side is lit, where that is asked for.
vec3 facing(vec3 n, vec3 v_normal, vec3 v_position) {
    if (u_two_sided == 0.0) return n;
    bool away = dot(v_normal, u_cam_pos - v_position) * u_two_sided < 0.0;
    return away ? -n : n;
}

vec3 bumped_normal() {
    vec3 n = normalize(v_normal);
    vec3 t = normalize(v_tangent);
    vec3 b = cross(n, t) * u_bitangent;
    float k = u_height_scaling * u_normal_scaling;
    float h0 = h(v_uv);
    float dU = (h(v_uv + vec2(1.0 / u_texture_2_size.x, 0.0)) - h0) * k;
    float dV = (h(v_uv + vec2(0.0, 1.0 / u_texture_2_size.y)) - h0) * k;
    vec3 local = normalize(vec3(-dU, -dV, 1.0));
    return normalize(t * local.x + b * local.y + n * local.z);
}

vec3 blinn_phong(vec3 v_position, vec3 n) {
    vec3 to_light = u_light_pos - v_position;
    float r2 = dot(to_light, to_light);
    vec3 l = normalize(to_light);
    vec3 v = normalize(u_cam_pos - v_position);
    vec3 h = normalize(l + v);
    vec3 irradiance = u_light_intensity * (1.0 / r2);
    vec3 diffuse = u_color * irradiance * (u_kd * max(0.0, dot(n, l)));
    vec3 specular = irradiance * (u_ks * pow(max(0.0, dot(n, h)), u_shininess));
    return vec3(u_ka) + diffuse + specular;
}

void main() {
    vec3 n = facing(bumped_normal(), v_normal, v_position);
    out_color = vec4(blinn_phong(v_position, n), 1.0);
}
