// Column-major 4x4 matrices in double: hierarchies may be deep.
#include "scene/gltf.h"

#include <string.h>

void gltf_matrix_identity(double m[16])
{
    memset(m, 0, 16 * sizeof *m);
    m[0] = m[5] = m[10] = m[15] = 1.0;
}

void gltf_matrix_multiply(const double a[16], const double b[16], double out[16])
{
    double r[16];
    for (int column = 0; column < 4; column++)
        for (int row = 0; row < 4; row++) {
            double sum = 0.0;
            for (int k = 0; k < 4; k++)
                sum += a[k * 4 + row] * b[column * 4 + k];
            r[column * 4 + row] = sum;
        }
    memcpy(out, r, sizeof r);
}

// T * R * S (spec 3.5.3); q = (x, y, z, w), unit.
void gltf_matrix_compose(const double t[3], const double q[4], const double s[3], double m[16])
{
    double x = q[0], y = q[1], z = q[2], w = q[3];
    double r[9] = {
        1 - 2 * (y * y + z * z), 2 * (x * y + z * w),     2 * (x * z - y * w),
        2 * (x * y - z * w),     1 - 2 * (x * x + z * z), 2 * (y * z + x * w),
        2 * (x * z + y * w),     2 * (y * z - x * w),     1 - 2 * (x * x + y * y),
    };
    gltf_matrix_identity(m);
    for (int column = 0; column < 3; column++)
        for (int row = 0; row < 3; row++)
            m[column * 4 + row] = r[column * 3 + row] * s[column];
    memcpy(m + 12, t, 3 * sizeof *t);
}

void gltf_matrix_cofactor(const double m[16], double c[9])
{
    for (int i = 0; i < 3; i++) {
        const double *a = m + (i + 1) % 3 * 4, *b = m + (i + 2) % 3 * 4;
        for (int j = 0; j < 3; j++) {
            int k = (j + 1) % 3, l = (j + 2) % 3;
            c[i * 3 + j] = a[k] * b[l] - a[l] * b[k];
        }
    }
}

double gltf_matrix_determinant(const double m[16])
{
    double c[9];
    gltf_matrix_cofactor(m, c);
    return m[0] * c[0] + m[1] * c[1] + m[2] * c[2];
}

bool gltf_matrix_is_collapsed(const double m[16])
{
    double cofactor[9];
    gltf_matrix_cofactor(m, cofactor);
    for (int i = 0; i < 9; i++)
        if (cofactor[i] > 0.0 || cofactor[i] < 0.0)
            return false;
    return true;
}
