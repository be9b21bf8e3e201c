// Each choice of a surface against its published form, written out here in double, and against
// quadrature.
#include "physics/surface_light.glsl"

#include "physics/sampling.glsl"

#include "albedo.h"
#include "near.h"

static const double TAU = 6.283185307179586;

static vec3 at(double cosine, double phi)
{
    double s = sqrt(1.0 - cosine * cosine);
    return vec3((float)(s * cos(phi)), (float)(s * sin(phi)), (float)cosine);
}

// A pair of directions of the upper hemisphere.
static void pair(uint i, uint count, vec3 *wo, vec3 *wi)
{
    vec2 u = sampling_hammersley(i, count);
    double a = (double)sampling_van_der_corput(7 * i + 1),
           b = (double)sampling_van_der_corput(3 * i);
    *wo = at(0.03 + 0.96 * (double)u[0], TAU * a);
    *wi = at(0.03 + 0.96 * (double)u[1], TAU * b);
}

// ---- Diffuse -----------------------------------------------------------------

// With angles and tangent vectors, as printed.
static double oren_nayar_by_angles(vec3 wo, vec3 wi, double sigma)
{
    double ti = acos((double)wi[2]), tr = acos((double)wo[2]);
    double a = 1 - 0.5 * sigma * sigma / (sigma * sigma + 0.33);
    double b = 0.45 * sigma * sigma / (sigma * sigma + 0.09);
    double dphi = atan2((double)wi[1], (double)wi[0]) - atan2((double)wo[1], (double)wo[0]);
    return (a + b * fmax(0, cos(dphi)) * sin(fmax(ti, tr)) * tan(fmin(ti, tr))) / acos(-1);
}

static void oren_nayar_is_the_printed_form(void **state)
{
    (void)state;
    for (uint i = 0; i < 2000; i++) {
        vec3 wo, wi;
        pair(i, 2000, &wo, &wi);
        float sigma = 1.5f * sampling_van_der_corput(i);
        float f = diffuse_oren_nayar(vec3(1, 1, 1), sigma, wi[2], wo[2], dot(wi, wo))[0];
        double expected = oren_nayar_by_angles(wo, wi, (double)sigma);
        assert_near((double)f, expected, 1e-4 * expected);
    }
}

// Where tangents overflow or have no direction.
static void rough_diffuse_is_total(void **state)
{
    (void)state;
    const float c[] = { 0, 1e-8f, 1 };
    for (int i = 0; i < 9; i++) {
        for (int k = -1; k <= 1; k++) {
            float f = diffuse_oren_nayar(vec3(1, 1, 1), 1.5f, c[i / 3], c[i % 3], (float)k)[0];
            vec3 e = diffuse_eon(vec3(1, 1, 1), 1, c[i / 3], c[i % 3], (float)k);
            assert_true(isfinite(f) && f >= 0 && isfinite(e[0]));
        }
        assert_true(isfinite(diffuse_oren_nayar_albedo(1.5f, c[i / 3])));
        assert_true(isfinite(diffuse_eon_albedo(vec3(1, 1, 1), 1, c[i / 3])[0]));
    }
    assert_near((double)diffuse_oren_nayar(vec3(1, 1, 1), 0, 0.5f, 0.5f, 1)[0], 1 / acos(-1), 1e-6);
    assert_near((double)diffuse_eon(vec3(1, 1, 1), 0, 0.5f, 0.5f, 1)[0], 1 / acos(-1), 1e-6);
}

// The integral over the light's hemisphere.
static double reflected(bool eon, float rho, float r, double NoV)
{
    enum { STEPS = 300 };
    vec3 wo = at(NoV, 0), color = vec3(rho, rho, rho);
    double sum = 0;
    for (int i = 0; i < STEPS; i++) {
        double u = (i + 0.5) / STEPS; // cos^2: the cosine's distribution
        for (int k = 0; k < STEPS; k++) {
            vec3 wi = at(sqrt(u), TAU / 2 * (k + 0.5) / STEPS);
            float LoV = dot(wo, wi);
            vec3 f = eon ? diffuse_eon(color, r, wi[2], wo[2], LoV)
                         : diffuse_oren_nayar(color, r, wi[2], wo[2], LoV);
            sum += (double)f[0];
        }
    }
    return sum * TAU / 2 / (STEPS * STEPS);
}

static void diffuse_albedos_are_the_integrals(void **state)
{
    (void)state;
    for (int i = 0; i < 4; i++) {
        double NoV = (double[]) { 0.05, 0.3, 0.7, 0.99 }[i];
        for (int k = 0; k < 3; k++) {
            float r = (float[]) { 0.2f, 0.6f, 1 }[k];
            assert_near((double)diffuse_oren_nayar_albedo(r, (float)NoV),
                        reflected(false, 1, r, NoV), 2e-3);
            vec3 e = diffuse_eon_albedo(vec3(0.7f, 0.7f, 0.7f), r, (float)NoV);
            assert_near((double)e[0], reflected(true, 0.7f, r, NoV), 2e-3);
        }
    }
}

// White EON reflects all of a white sky; nothing else does Oren-Nayar's of old.
static void eon_preserves_energy(void **state)
{
    (void)state;
    for (int i = 0; i < 5; i++) {
        double NoV = (double[]) { 0.06, 0.2, 0.5, 0.8, 1 }[i];
        assert_near(reflected(true, 1, 1, NoV), 1, 2e-3);
        assert_near(reflected(true, 1, 0.3f, NoV), 1, 2e-3);
        assert_true(reflected(false, 1, 1, NoV) < 0.97);
    }
}

static void eon_is_reciprocal(void **state)
{
    (void)state;
    for (uint i = 0; i < 500; i++) {
        vec3 a, b, rho = vec3(0.9f, 0.5f, 0.1f);
        pair(i, 500, &a, &b);
        vec3 ab = diffuse_eon(rho, 0.8f, a[2], b[2], dot(a, b));
        vec3 ba = diffuse_eon(rho, 0.8f, b[2], a[2], dot(a, b));
        for (int k = 0; k < 3; k++)
            assert_near((double)ab[k], (double)ba[k], 1e-6);
    }
}

// ---- Lobes -------------------------------------------------------------------

static void anisotropic_distribution_is_normalised(void **state)
{
    (void)state;
    const float alphas[][2] = { { 0.5f, 0.05f }, { 0.1f, 0.1f }, { 1, 0.2f } };
    for (int a = 0; a < 3; a++) {
        enum { STEPS = 1500 };
        double sum = 0;
        for (int i = 0; i < STEPS; i++) {
            double t = (i + 0.5) / STEPS, z = 1 - t * t * t; // finer towards the pole
            for (int k = 0; k < STEPS; k++) {
                vec3 h = at(z, TAU / 4 * (k + 0.5) / STEPS);
                float d = microfacet_d_anisotropic(h, alphas[a][0], alphas[a][1]);
                sum += (double)d * z * 3 * t * t;
            }
        }
        assert_near(sum * TAU / STEPS / STEPS, 1, 2e-3);
    }
}

// Heitz' Lambda with alpha taken along each direction's azimuth.
static double heitz_lambda(vec3 w, double ax, double ay)
{
    double phi = atan2((double)w[1], (double)w[0]);
    double a2 = pow(ax * cos(phi), 2) + pow(ay * sin(phi), 2);
    double tan2 = 1 / ((double)w[2] * (double)w[2]) - 1;
    return (sqrt(1 + a2 * tan2) - 1) / 2;
}

static void anisotropic_visibility_is_the_paper_s(void **state)
{
    (void)state;
    for (uint i = 0; i < 1000; i++) {
        vec3 wo, wi;
        pair(i, 1000, &wo, &wi);
        double g2 = 1 / (1 + heitz_lambda(wo, 0.7, 0.1) + heitz_lambda(wi, 0.7, 0.1));
        double expected = g2 / (4 * (double)wo[2] * (double)wi[2]);
        float v = microfacet_v_anisotropic(wo, wi, 0.7f, 0.1f);
        assert_near((double)v / expected, 1, 1e-4);
        assert_near((double)microfacet_v_anisotropic(wo, wi, 0.3f, 0.3f),
                    (double)microfacet_v(wo[2], wi[2], 0.09f), 1e-4 * expected + 1e-5);
    }
}

static surface_material plain(uint model)
{
    return (surface_material) {
        .base_color = vec3(0.8f, 0.5f, 0.3f),
        .metallic = 0.25f,
        .roughness = 0.5f,
        .dielectric_f0 = 0.04f,
        .specular_color = vec3(1, 1, 1),
        .specular = 1,
        .model = model,
        .diffuse_roughness = 0.7f,
        .shininess = 40,
        .anisotropy = 0.6f,
        .tangent = vec3(0.6f, 0.8f, 0),
        .conductor_n = vec3(0.18601f, 0.59580f, 1.4120f), // gold
        .conductor_k = vec3(3.3762f, 2.0765f, 1.7827f),
        .f82_tint = vec3(0.7f, 0.8f, 0.9f),
        .reflectiveness = 0.75f,
    };
}

static const vec3 up = { 0, 0, 1 };

static double max0(double x)
{
    return x > 0 ? x : 0;
}

// The well-known shader of point lights: Schlick-GGX with k = (r + 1)^2 / 8, base (1 - F)(1 -
// metallic); its .0001 in the denominator left out.
static void layering_by_f_is_the_well_known_shader(void **state)
{
    (void)state;
    surface_material m = plain(SURFACE_SCHLICK_GGX | SURFACE_LAYERED_BY_F | SURFACE_SINGLE_BOUNCE);
    for (uint i = 0; i < 500; i++) {
        vec3 wo, wi;
        pair(i, 500, &wo, &wi);
        vec3 h = normalize(wo + wi);
        double NoV = (double)wo[2], NoL = (double)wi[2], NoH = (double)h[2];
        double r = (double)m.roughness, a2 = pow(r, 4), k = (r + 1) * (r + 1) / 8;
        double d = a2 / (acos(-1) * pow(NoH * NoH * (a2 - 1) + 1, 2));
        double g = NoV / (NoV * (1 - k) + k) * NoL / (NoL * (1 - k) + k);
        surface s = surface_from_metallic_roughness(m, wo[2], vec2(0.7f, 0.05f));
        vec3 got = surface_direct(s, up, wo, wi);
        for (int c = 0; c < 3; c++) {
            double base = (double)m.base_color[c], metallic = (double)m.metallic;
            double f0 = 0.04 * (1 - metallic) + base * metallic;
            double f = f0 + (1 - f0) * pow(1 - max0((double)dot(h, wo)), 5);
            double kd = (1 - f) * (1 - metallic);
            double expected = (kd * base / acos(-1) + d * g * f / (4 * NoV * NoL)) * NoL;
            assert_near((double)got[c], expected, 2e-4 * expected + 1e-6);
        }
    }
}

// Reflectiveness blends lobe and base; metalness a coloured and a colourless lobe, both of
// Smith's Lambda.
static void blend_is_the_linear_one(void **state)
{
    (void)state;
    surface_material m = plain(SURFACE_BLENDED | SURFACE_SINGLE_BOUNCE);
    for (uint i = 0; i < 500; i++) {
        vec3 wo, wi;
        pair(i, 500, &wo, &wi);
        vec3 h = normalize(wo + wi);
        double a2 = pow((double)m.roughness, 4), NoH = (double)h[2], alpha = sqrt(a2);
        double d = a2 / (acos(-1) * pow(NoH * NoH * (a2 - 1) + 1, 2));
        double g = 1 / (1 + heitz_lambda(wo, alpha, alpha) + heitz_lambda(wi, alpha, alpha));
        double w = pow(1 - (double)dot(wo, h), 5), lobe = d * g / (4 * (double)wo[2]);
        surface s = surface_from_metallic_roughness(m, wo[2], vec2(0.7f, 0.05f));
        vec3 got = surface_direct(s, up, wo, wi);
        for (int c = 0; c < 3; c++) {
            double base = (double)m.base_color[c];
            double metal = lobe * (base + (1 - base) * w), other = lobe * (0.04 + 0.96 * w);
            double specular = other * 0.75 + metal * 0.25;
            double diffuse = base / acos(-1) * (double)wi[2];
            double expected = 0.75 * specular + 0.25 * diffuse;
            assert_near((double)got[c], expected, 2e-4 * expected + 1e-6);
        }
    }
}

// glTF 2.0, appendix B.2: mix(fresnel_mix(diffuse, specular), conductor, metallic).
static void gltf_layering_is_the_specification_s(void **state)
{
    (void)state;
    surface_material m = plain(SURFACE_LAYERED_AS_GLTF | SURFACE_SINGLE_BOUNCE);
    for (uint i = 0; i < 500; i++) {
        vec3 wo, wi;
        pair(i, 500, &wo, &wi);
        double VoH = (double)dot(wo, normalize(wo + wi)), w = pow(1 - VoH, 5), a = 0.25;
        double g = 1 / (1 + heitz_lambda(wo, a, a) + heitz_lambda(wi, a, a));
        double NoH = (double)normalize(wo + wi)[2];
        double d = a * a / (acos(-1) * pow(NoH * NoH * (a * a - 1) + 1, 2));
        double specular = d * g / (4 * (double)wo[2]);
        surface s = surface_from_metallic_roughness(m, wo[2], vec2(0.7f, 0.05f));
        vec3 got = surface_direct(s, up, wo, wi);
        for (int c = 0; c < 3; c++) {
            double base = (double)m.base_color[c], f = 0.04 + 0.96 * w;
            double dielectric = (1 - f) * base / acos(-1) * (double)wi[2] + f * specular;
            double metal = specular * (base + (1 - base) * w);
            double expected = 0.75 * dielectric + 0.25 * metal;
            assert_near((double)got[c], expected, 2e-4 * expected + 1e-6);
        }
    }
}

// m_S clamp(n.h)^gamma beside m_D cos, under a light of illuminance pi; also from below.
static void blinn_is_the_old_light_model_s(void **state)
{
    (void)state;
    surface_material m = plain(SURFACE_BLINN);
    m.metallic = 0;
    m.specular_color = vec3(0.9f, 0.6f, 0.3f);
    for (uint i = 0; i < 500; i++) {
        vec3 wo, wi;
        pair(i, 500, &wo, &wi);
        wi[2] = i % 5 ? wi[2] : -wi[2];
        vec3 sum = wo + wi;
        double NoH = (double)sum[2] / sqrt((double)dot(sum, sum));
        surface s = surface_from_metallic_roughness(m, wo[2], vec2(0.7f, 0.05f));
        vec3 got = surface_direct(s, up, wo, wi);
        for (int c = 0; c < 3; c++) {
            double expected = (double)m.base_color[c] * max0((double)wi[2]) +
                              (double)m.specular_color[c] * pow(max0(NoH), 40);
            assert_near(acos(-1) * (double)got[c], expected, 1e-3 * expected + 1e-6);
        }
    }
}

// ---- Fresnel -----------------------------------------------------------------

static void f82_has_its_tint_at_82_degrees(void **state)
{
    (void)state;
    surface_material m = plain(SURFACE_F82 | SURFACE_SINGLE_BOUNCE);
    m.metallic = 1;
    surface s = surface_from_metallic_roughness(m, 1, vec2(1, 0));
    vec3 schlick = fresnel_schlick(m.base_color, 1, 1.0f / 7);
    vec3 f = surface_fresnel(s, 1.0f / 7), head_on = surface_fresnel(s, 1);
    for (int c = 0; c < 3; c++) {
        assert_near((double)f[c], (double)(m.f82_tint[c] * schlick[c]), 1e-5);
        assert_near((double)head_on[c], (double)m.base_color[c], 1e-6);
        assert_near((double)surface_fresnel(s, 0)[c], 1, 1e-6);
    }
}

// With the tint of a conductor's own value at 82 degrees it is the exact one to .03; Schlick's
// is not.
static void f82_follows_conductors(void **state)
{
    (void)state;
    const float indices[][2] = {
        { 0.186f, 3.376f }, { 0.596f, 2.08f }, { 1.17f, 6.99f }, { 3.18f, 3.33f }, { 2.5f, 3.4f }
    };
    for (int i = 0; i < 5; i++) {
        float n = indices[i][0], k = indices[i][1], f0 = fresnel_f0_conductor(n, k);
        vec3 rgb = vec3(f0, f0, f0), at82 = fresnel_schlick(rgb, 1, 1.0f / 7);
        float tint = fresnel_conductor(1.0f / 7, n, k) / at82[0];
        vec3 dip = fresnel_f82(rgb, vec3(tint, tint, tint));
        double worst = 0, schlick = 0;
        for (int c = 0; c <= 100; c++) {
            float x = (float)c / 100, exact = fresnel_conductor(x, n, k);
            float plain_form = fresnel_schlick(rgb, 1, x)[0];
            worst = fmax(worst, fabs((double)(plain_form - fresnel_dip(x) * dip[0] - exact)));
            schlick = fmax(schlick, fabs((double)(plain_form - exact)));
        }
        assert_true(worst < 0.03);
        assert_true(i < 2 || worst < 0.5 * schlick);
    }
}

static void fresnel_means_are_the_integrals(void **state)
{
    (void)state;
    double dip = 0, gold[3] = { 0, 0, 0 };
    vec3 n = vec3(0.18601f, 0.59580f, 1.4120f), k = vec3(3.3762f, 2.0765f, 1.7827f);
    enum { STEPS = 20000 };
    for (int i = 0; i < STEPS; i++) {
        float c = ((float)i + 0.5f) / STEPS;
        vec3 f = fresnel_conductor_rgb(c, n, k);
        dip += 2 * (double)(c * fresnel_dip(c)) / STEPS;
        for (int q = 0; q < 3; q++)
            gold[q] += 2 * (double)(c * f[q]) / STEPS;
    }
    assert_near(dip, 1.0 / 126, 1e-6);
    for (int q = 0; q < 3; q++)
        assert_near((double)fresnel_conductor_mean(n, k)[q], gold[q], 0.005);
    assert_true(isfinite(fresnel_conductor(0, 1, 0)) && isfinite(fresnel_conductor(1, 1, 0)));
}

// Three metals' indices at the wavelengths of red, green and blue, and what they must reflect.
static void three_channels_of_gold_silver_and_copper(void **state)
{
    (void)state;
    const struct {
        float n[3], k[3];
        double f0[3];
    } metals[] = {
        { { 0.18601f, 0.59580f, 1.4120f },
          { 3.3762f, 2.0765f, 1.7827f },
          { 0.9419, 0.6525, 0.3721 } },
        { { 0.15865f, 0.14215f, 0.13533f },
          { 3.8929f, 3.0051f, 2.3276f },
          { 0.9615, 0.9450, 0.9193 } },
        { { 0.28046f, 0.85418f, 1.3284f },
          { 3.5587f, 2.4518f, 2.2949f },
          { 0.9216, 0.6384, 0.5028 } },
    };
    for (int i = 0; i < 3; i++) {
        surface_material m = plain(SURFACE_CONDUCTOR | SURFACE_SINGLE_BOUNCE);
        m.metallic = 1;
        m.conductor_n = vec3(metals[i].n[0], metals[i].n[1], metals[i].n[2]);
        m.conductor_k = vec3(metals[i].k[0], metals[i].k[1], metals[i].k[2]);
        surface s = surface_from_metallic_roughness(m, 1, vec2(1, 0));
        vec3 f = surface_fresnel(s, 1);
        for (int c = 0; c < 3; c++) {
            double n = (double)metals[i].n[c], k = (double)metals[i].k[c];
            double printed = ((n - 1) * (n - 1) + k * k) / ((n + 1) * (n + 1) + k * k);
            assert_near((double)f[c], printed, 1e-5);
            assert_near((double)f[c], metals[i].f0[c], 1e-4);
        }
    }
}

// ---- Energy ------------------------------------------------------------------

// Anisotropic visible normals by brute force: the albedo for F = 1, and its part with (1 - v.h)^5.
static albedo anisotropic_albedo(vec3 wo, double ax, double ay, int steps)
{
    double v[3] = { (double)wo[0], (double)wo[1], (double)wo[2] };
    double s[3] = { ax * v[0], ay * v[1], v[2] },
           length = sqrt(s[0] * s[0] + s[1] * s[1] + s[2] * s[2]);
    double all = 0, grazing = 0;
    for (int i = 0; i < steps; i++) {
        double t = (i + 0.5) / steps, u = 1 - (1 - t) * (1 - t), du = 2 * (1 - t) / steps;
        double z = (1 - u) * (1 + s[2] / length) - s[2] / length, r = sqrt(fmax(1 - z * z, 0));
        for (int k = 0; k < steps; k++) {
            double phi = TAU * (k + 0.5) / steps;
            double h[3] = { ax * (r * cos(phi) + s[0] / length),
                            ay * (r * sin(phi) + s[1] / length), z + s[2] / length };
            double h2 = h[0] * h[0] + h[1] * h[1] + h[2] * h[2];
            double vh = v[0] * h[0] + v[1] * h[1] + v[2] * h[2], l[3];
            for (int q = 0; q < 3; q++)
                l[q] = 2 * vh / h2 * h[q] - v[q];
            if (l[2] <= 0)
                continue;
            double sl = sqrt(pow(ax * l[0], 2) + pow(ay * l[1], 2) + l[2] * l[2]);
            double g = l[2] * (length + v[2]) / (l[2] * length + sl * v[2]) * du / steps;
            all += g;
            grazing += g * pow(1 - vh / sqrt(h2), 5);
        }
    }
    return (albedo) { all - grazing, grazing };
}

// Also the white furnace: what the estimate of E lacks is what a white metal would.
static void sky_is_the_lobe_s_albedo(void **state)
{
    (void)state;
    const float roughness[] = { 0.15f, 0.3f, 0.5f, 0.7f, 0.85f, 1 };
    const float strengths[] = { 0, 0.3f, 0.6f, 1 };
    for (int i = 0; i < 6 * 4 * 5 * 3; i++) {
        double NoV = (double[]) { 0.06, 0.2, 0.5, 0.8, 0.99 }[i / 24 % 5];
        surface_material m = plain(SURFACE_ANISOTROPIC);
        m.roughness = roughness[i % 6];
        m.anisotropy = strengths[i / 6 % 4];
        m.tangent = vec3(1, 0, 0);
        vec3 wo = at(NoV, TAU / 8 * (i / 120));
        vec2 alphas = microfacet_alphas(m.roughness * m.roughness, m.anisotropy);
        albedo e = anisotropic_albedo(wo, (double)alphas[0], (double)alphas[1], 90);
        vec2 sky = surface_sky(m, up, wo);
        assert_near((double)(sky[0] + sky[1]), e.scale + e.bias, 0.009);
        assert_near((double)sky[1], e.bias, 0.006);
    }
}

// EON under the default lobe, in image light: white on white cannot be seen.
static void rough_diffuse_furnace(void **state)
{
    (void)state;
    for (int i = 0; i < 20; i++) {
        double NoV = (double[]) { 0.06, 0.2, 0.5, 0.8, 0.99 }[i % 5];
        surface_material m = plain(SURFACE_EON);
        m.base_color = vec3(1, 1, 1);
        m.metallic = 0;
        m.roughness = 0.3f + 0.2f * (float)(i / 5);
        m.diffuse_roughness = 1;
        albedo e = albedo_of(NoV, pow((double)m.roughness, 2), 100);
        surface s =
            surface_from_metallic_roughness(m, (float)NoV, vec2((float)e.scale, (float)e.bias));
        vec3 one = vec3(1, 1, 1);
        assert_near((double)surface_environment(s, one, one)[0], 1, 1e-4);
        // The base alone under lights, against what it is said to be.
        s.f0 = s.lambert = s.bounced = vec3(0, 0, 0);
        s.f90 = 0;
        double sum = 0;
        enum { STEPS = 100 };
        for (int k = 0; k < STEPS * STEPS; k++) {
            vec3 wi = at(sqrt((k / STEPS + 0.5) / STEPS), TAU * (k % STEPS + 0.5) / STEPS);
            sum += (double)(surface_direct(s, up, at(NoV, 0), wi)[0] / wi[2]);
        }
        assert_near(sum * TAU / 2 / (STEPS * STEPS), (double)s.base_albedo[0], 3e-3);
    }
}

// Image light takes Fresnel at one cosine: against the integral of the lobe with the Fresnel
// inside.
static void image_light_has_the_mean_of_fresnel(void **state)
{
    (void)state;
    for (int i = 0; i < 2 * 4 * 4; i++) {
        double NoV = (double[]) { 0.1, 0.3, 0.6, 0.95 }[i % 4], worst = 0;
        uint model = i / 16 ? SURFACE_F82 : SURFACE_CONDUCTOR;
        surface_material m = plain(model | SURFACE_SINGLE_BOUNCE);
        m.metallic = 1;
        m.roughness = (float[]) { 0.2f, 0.5f, 0.75f, 1 }[i / 4 % 4];
        double alpha = pow((double)m.roughness, 2), a2 = alpha * alpha, sum[3] = { 0, 0, 0 };
        albedo e = albedo_of(NoV, alpha, 150);
        surface s =
            surface_from_metallic_roughness(m, (float)NoV, vec2((float)e.scale, (float)e.bias));
        enum { STEPS = 150 };
        for (int k = 0; k < STEPS * STEPS; k++) { // as albedo_of()
            double t = (k / STEPS + 0.5) / STEPS, u = 1 - pow(1 - t, 3);
            double NoH = sqrt((1 - u) / (1 + (a2 - 1) * u)),
                   phi = TAU / 2 * (k % STEPS + 0.5) / STEPS;
            double VoH = sqrt(1 - NoV * NoV) * sqrt(1 - NoH * NoH) * cos(phi) + NoV * NoH;
            double NoL = 2 * VoH * NoH - NoV;
            if (VoH <= 0 || NoL <= 0)
                continue;
            double g = albedo_g2(NoV, NoL, a2) * VoH / (NoV * NoH) * 3 * (1 - t) * (1 - t);
            vec3 f = surface_fresnel(s, (float)VoH);
            for (int c = 0; c < 3; c++)
                sum[c] += g * (double)f[c] / (STEPS * STEPS);
        }
        for (int c = 0; c < 3; c++)
            worst = fmax(worst, fabs((double)s.single[c] - sum[c]));
        assert_true(worst < (model == SURFACE_F82 ? 0.04 : 0.01));
    }
}

// Every part is: the weights are those of one surface here.  Not so further bounces, whose
// direction is a fit, nor Blinn's lobe, which is of the light and not of the irradiance.
static void parts_are_reciprocal(void **state)
{
    (void)state;
    vec3 n = vec3(0, 0, 1);
    for (uint model = 0; model < SURFACE_MODELS; model++) {
        if ((model & SURFACE_DISTRIBUTION) >= SURFACE_BLINN ||
            (model & SURFACE_DIFFUSE) > SURFACE_EON || (model & SURFACE_FRESNEL) == SURFACE_FRESNEL)
            continue;
        surface_material m = plain(model);
        m.metallic = 0.5f;
        surface s = surface_from_metallic_roughness(m, 0.6f, vec2(0.7f, 0.1f));
        s.bounced = vec3(0, 0, 0);
        for (uint i = 0; i < 20; i++) {
            vec3 a, b;
            pair(i, 20, &a, &b);
            vec3 ab = surface_direct(s, n, a, b) / b[2], ba = surface_direct(s, n, b, a) / a[2];
            for (int k = 0; k < 3; k++)
                assert_near((double)ab[k], (double)ba[k], 2e-5 * (double)ab[k] + 1e-6);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(oren_nayar_is_the_printed_form),
        cmocka_unit_test(rough_diffuse_is_total),
        cmocka_unit_test(diffuse_albedos_are_the_integrals),
        cmocka_unit_test(eon_preserves_energy),
        cmocka_unit_test(eon_is_reciprocal),
        cmocka_unit_test(parts_are_reciprocal),
        cmocka_unit_test(anisotropic_distribution_is_normalised),
        cmocka_unit_test(anisotropic_visibility_is_the_paper_s),
        cmocka_unit_test(layering_by_f_is_the_well_known_shader),
        cmocka_unit_test(blend_is_the_linear_one),
        cmocka_unit_test(gltf_layering_is_the_specification_s),
        cmocka_unit_test(blinn_is_the_old_light_model_s),
        cmocka_unit_test(f82_has_its_tint_at_82_degrees),
        cmocka_unit_test(f82_follows_conductors),
        cmocka_unit_test(fresnel_means_are_the_integrals),
        cmocka_unit_test(three_channels_of_gold_silver_and_copper),
        cmocka_unit_test(sky_is_the_lobe_s_albedo),
        cmocka_unit_test(rough_diffuse_furnace),
        cmocka_unit_test(image_light_has_the_mean_of_fresnel),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
