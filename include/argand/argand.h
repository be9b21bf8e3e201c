// Argand: a physically based real-time renderer.  This header is the whole API.
#ifndef ARGAND_ARGAND_H
#define ARGAND_ARGAND_H

#include <argand/base.h>
#include <argand/compare.h>
#include <argand/eye.h>
#include <argand/image.h>
#include <argand/metal.h>
#include <argand/reference.h>
#include <argand/renderer.h>
#include <argand/scene.h>
#include <argand/window.h>

#endif
