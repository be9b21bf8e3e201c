// Vertices on their way from object to world space, by the rows of gpu_instance.
#ifndef AG_PASSES_VERTEX_GLSL
#define AG_PASSES_VERTEX_GLSL

vec3 world_position(vec4 rows[3], vec3 position)
{
    vec4 p = vec4(position, 1.0);
    return vec3(dot(rows[0], p), dot(rows[1], p), dot(rows[2], p));
}

// Normals go by the cofactors, which are right under any scaling; mirrored ones would turn
// inside out, hence the sign of the determinant.
struct world_frame {
    vec3 x, y, z; // rows, made of size 1 lest the cofactors overflow
    float flip;   // -1: mirrored
};

world_frame world_frame_of(vec4 rows[3])
{
    vec3 x = rows[0].xyz, y = rows[1].xyz, z = rows[2].xyz;
    float size = inversesqrt(dot(x, x) + dot(y, y) + dot(z, z));
    world_frame f = world_frame(x * size, y * size, z * size, 1.0);
    f.flip = dot(f.x, cross(f.y, f.z)) < 0.0 ? -1.0 : 1.0;
    return f;
}

vec3 world_normal(world_frame f, vec3 n)
{
    return f.flip * normalize(vec3(dot(cross(f.y, f.z), n), dot(cross(f.z, f.x), n),
                                   dot(cross(f.x, f.y), n)));
}

vec4 world_tangent(world_frame f, vec4 tangent)
{
    vec3 t = vec3(dot(f.x, tangent.xyz), dot(f.y, tangent.xyz), dot(f.z, tangent.xyz));
    float length2 = dot(t, t);
    return vec4(length2 > 0.0 ? t * inversesqrt(length2) : vec3(0.0), f.flip * tangent.w);
}

#endif
