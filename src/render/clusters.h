// Which lights reach which part of the picture.
//
// Olsson, Billeter, Assarsson 2012, "Clustered Deferred and Forward Shading": tiles of the
// picture, cut in depth in steps of one ratio.
#ifndef AG_RENDER_CLUSTERS_H
#define AG_RENDER_CLUSTERS_H

#include "render/lights.h"

// Write l->clusters for one tile of the picture, and the frame's part that finds a cluster.
AG_CHECK ag_status clusters_write(gpu_device *device, const view *v, view_rect tile, lights *l,
                                  gpu_frame *frame);

#endif
