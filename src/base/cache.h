// Where things that can be made again are kept between runs.
//
// The folder is $ARGAND_CACHE_DIR, else $XDG_CACHE_HOME/argand, else ~/.cache/argand,
// else /tmp/argand-UID.  ARGAND_NO_CACHE=1 means: none.
#ifndef AG_BASE_CACHE_H
#define AG_BASE_CACHE_H

#include <stdbool.h>

// False when ARGAND_NO_CACHE says so.
bool cache_wanted(void);

enum { CACHE_PATH_MAX = 4096 };

// The path of the cache's folder `part`, made if it is not there; false when there is
// none that can be written.
bool cache_directory(const char *part, char path[CACHE_PATH_MAX]);

#endif
