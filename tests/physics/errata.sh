#!/bin/sh
# docs/errata.md, 9: do the misprinted listings fail to compile, and compile when put right?
#
#   errata.sh GLSLC
set -eu
glslc=$1

# listing DECLARATIONS STATEMENTS: as a fragment shader.
listing() {
    printf '#version 460\nlayout(location = 0) in vec3 N;\nlayout(location = 1) in vec3 L;
layout(location = 0) out vec4 result;\nlayout(binding = 0) uniform Ubo { mat4 worldMat; } ubo;
%s\nvoid main()\n{\n%s\n}\n' "$1" "$2" | "$glslc" -fshader-stage=fragment -o /dev/null - 2>/dev/null
}

right() { listing "$@" || { echo "refused: $*"; exit 1; }; }
wrong() { ! listing "$@" || { echo "compiled: $*"; exit 1; }; }

schlick='return F0 + (1.0 - F0) * pow(clamp(1.0 - cosTheta, 0.0, 1.0), 5.0);'
wrong "vec3 fresnelSchlick(flat cosTheta, vec3 F0) { $schlick }" ''
wrong 'vec3 fresnelSchlick(float cosTheta, vec3 F0)
{ return F0 + (1.0 - F0) * pow(clamp(1 - cosTheta, 0.0, 1.0,) 5.0); }' ''
right "vec3 fresnelSchlick(float cosTheta, vec3 F0) { $schlick }" ''

wrong 'float D(float roughnes) { return rougness * rougness; }' ''
right 'float D(float roughness) { return roughness * roughness; }' ''

wrong 'float DistrubutionGGX(float NoH) { return NoH; }' 'result = vec4(DistributionGGX(1.0));'
right 'float DistributionGGX(float NoH) { return NoH; }' 'result = vec4(DistributionGGX(1.0));'

wrong '' 'vec3 wi = normalize(L); result = vec4(max(dot(N, Wi), 0.0));'
right '' 'vec3 wi = normalize(L); result = vec4(max(dot(N, wi), 0.0));'

wrong '' 'result = ubo.mvpMat * vec4(N, 1.0);'
right '' 'result = ubo.worldMat * vec4(N, 1.0);'
