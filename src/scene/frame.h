// Meshes as a frame of its own sees them, in double.
#ifndef AG_SCENE_FRAME_H
#define AG_SCENE_FRAME_H

// A frame: `origin` and three unit axes, the last one towards the eye.
typedef struct frame {
    double origin[3];
    double axis[3][3];
} frame;

// The way from an instance's mesh to a frame.
typedef struct affine {
    double m[3][4];
} affine;

static inline affine frame_from_mesh(const frame *f, const float world[16])
{
    affine a;
    for (int row = 0; row < 3; row++) {
        for (int column = 0; column < 4; column++) {
            a.m[row][column] = 0.0;
            for (int i = 0; i < 3; i++)
                a.m[row][column] += f->axis[row][i] * ((double)world[4 * column + i] -
                                                       (column == 3 ? f->origin[i] : 0.0));
        }
    }
    return a;
}

// One coordinate of a point of the mesh.
static inline double affine_row(const affine *a, int row, const float p[3])
{
    const double *m = a->m[row];
    return m[0] * (double)p[0] + m[1] * (double)p[1] + m[2] * (double)p[2] + m[3];
}

#endif
