// Finds vertices that are the same point of a surface, by an open-addressing hash table.
#include "scene/weld.h"

#include <stdlib.h>
#include <string.h>

enum { WORDS = 8 };

typedef struct key {
    float values[WORDS];
} key;

static key key_of(const scene_mesh *mesh, unsigned uv_set, uint32_t index)
{
    const scene_vertex *v = &mesh->vertices[index];
    key k = { { v->position[0], v->position[1], v->position[2], v->normal[0], v->normal[1],
                v->normal[2], v->uv[uv_set][0], v->uv[uv_set][1] } };
    for (int i = 0; i < WORDS; i++)
        k.values[i] += 0.0f; // -0 becomes 0, so that equal numbers have equal bytes
    return k;
}

// Multiply and rotate, two words at a time; the constants are odd and otherwise arbitrary.
static uint64_t hash_of(const key *k)
{
    uint64_t words[WORDS / 2], hash = 0x9e3779b97f4a7c15u;
    memcpy(words, k, sizeof words);
    for (int i = 0; i < WORDS / 2; i++) {
        hash = (hash ^ words[i]) * 0xd6e8feb86659fd93u;
        hash ^= hash >> 32;
    }
    return hash * 0xd6e8feb86659fd93u;
}

typedef struct slot {
    uint32_t vertex; // index + 1; 0 = empty
    uint32_t tag;    // some bits of the hash
} slot;

bool weld_vertices(const scene_mesh *mesh, unsigned uv_set, uint32_t *welded)
{
    unsigned bits = 4;
    while ((size_t)1 << bits < (size_t)mesh->vertex_count * 2)
        bits++;
    size_t mask = ((size_t)1 << bits) - 1;
    slot *table = calloc(mask + 1, sizeof *table);
    if (!table)
        return false;
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        key k = key_of(mesh, uv_set, i);
        uint64_t hash = hash_of(&k);
        uint32_t tag = (uint32_t)hash;
        size_t at = (size_t)(hash >> (64 - bits));
        for (;; at = (at + 1) & mask) {
            if (table[at].vertex == 0) {
                table[at] = (slot) { i + 1, tag };
                welded[i] = i;
                break;
            }
            if (table[at].tag != tag)
                continue;
            key other = key_of(mesh, uv_set, table[at].vertex - 1);
            if (memcmp(&k, &other, sizeof k) == 0) {
                welded[i] = table[at].vertex - 1;
                break;
            }
        }
    }
    free(table);
    return true;
}
