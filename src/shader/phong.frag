#version 330

uniform vec3 u_cam_pos;
uniform vec3 u_color;
uniform vec3 u_light_pos;
uniform vec3 u_light_intensity;
uniform float u_ka;
uniform float u_kd;
uniform float u_ks;
uniform float u_shininess;
uniform float u_two_sided;

in vec3 v_position;
in vec3 v_normal;

out vec4 out_color;

// Away from the camera the other side is lit, where that is asked for.
vec3 facing(vec3 n, vec3 v_normal, vec3 v_position) {
    if (u_two_sided == 0.0) return n;
    bool away = dot(v_normal, u_cam_pos - v_position) * u_two_sided < 0.0;
    return away ? -n : n;
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
    vec3 n = facing(normalize(v_normal), v_normal, v_position);
    out_color = vec4(blinn_phong(v_position, n), 1.0);
}
