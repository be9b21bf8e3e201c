// Deflate without search: RFC 1951; Adler-32: RFC 1950.
#include "image/deflate.h"

#include <stdlib.h>
#include <string.h>

enum {
    SYMBOLS = 286, // literals, the end of the block, lengths
    END = 256,
    RUN_MIN = 4, // bytes; a shorter run is cheaper as literals
    RUN_MAX = 258,
    CODE_LENGTH = 15, // bits at most
};

// A token below 256 is a literal; above it a run of token - 256 bytes like the one before.

typedef struct codes {
    uint8_t length[SYMBOLS]; // bits
    uint16_t bits[SYMBOLS];  // in the order in which they are written
} codes;

typedef struct writer {
    uint64_t bits;
    unsigned count;
    uint8_t *out;
} writer;

// After flush() fewer than 8 bits wait: there is room for 56 more.
static inline void add(writer *w, uint32_t bits, unsigned count)
{
    w->bits |= (uint64_t)bits << w->count;
    w->count += count;
}

// Writes 8 bytes, of which the whole ones count.
static inline void flush(writer *w)
{
    for (int i = 0; i < 8; i++)
        w->out[i] = (uint8_t)(w->bits >> 8 * i);
    w->out += w->count >> 3;
    w->bits >>= w->count & ~7u;
    w->count &= 7;
}

static void put(writer *w, uint32_t bits, unsigned count)
{
    add(w, bits, count);
    flush(w);
}

static void put_rest(writer *w)
{
    w->count = (w->count + 7) & ~7u;
    flush(w);
}

// RFC 1951, 3.2.5: the symbol of a length, its extra bits and their number.
typedef struct length_code {
    uint16_t symbol;
    uint8_t extra, extra_bits;
} length_code;

static length_code length_code_of(unsigned length)
{
    if (length == RUN_MAX)
        return (length_code) { 285, 0, 0 };
    unsigned n = length - 3;
    if (n < 8)
        return (length_code) { (uint16_t)(257 + n), 0, 0 };
    unsigned log = 31 - (unsigned)__builtin_clz(n), bits = log - 2;
    return (length_code) { (uint16_t)(257 + 4 * bits + (n >> bits)),
                           (uint8_t)(n & ((1u << bits) - 1)), (uint8_t)bits };
}

// How many bytes of `p` are like the one before it: none below RUN_MIN = 4.
static size_t run_length(const uint8_t *p, size_t left)
{
    uint64_t same = p[-1] * 0x0101010101010101u, next = 0;
    if (left < RUN_MIN || memcmp(p, &same, RUN_MIN) != 0)
        return 0;
    size_t n = RUN_MIN, most = left < RUN_MAX ? left : RUN_MAX;
    while (n + 8 <= most && (memcpy(&next, p + n, 8), next == same))
        n += 8;
    while (n < most && p[n] == p[-1])
        n++;
    return n;
}

static size_t find_runs(const uint8_t *data, size_t size, uint16_t *tokens, uint32_t *frequency)
{
    size_t count = 0;
    for (size_t i = 0; i < size;) {
        size_t run = i > 0 ? run_length(data + i, size - i) : 0;
        if (run) {
            tokens[count++] = (uint16_t)(256 + run);
            frequency[length_code_of((unsigned)run).symbol]++;
            i += run;
        } else {
            tokens[count++] = data[i];
            frequency[data[i++]]++;
        }
    }
    frequency[END] = 1;
    return count;
}

typedef struct leaf {
    uint32_t frequency;
    uint16_t symbol;
} leaf;

static int compare_leaves(const void *a, const void *b)
{
    const leaf *p = a, *q = b;
    if (p->frequency != q->frequency)
        return p->frequency < q->frequency ? -1 : 1;
    return p->symbol - q->symbol;
}

// Huffman (1952) over leaves in rising order of frequency: how many codes of each length.
// Both queues, leaves and inner nodes, rise, so that the two least stand at their heads.
static void count_lengths(const leaf *leaves, unsigned count, unsigned at[CODE_LENGTH + 1])
{
    uint32_t weight[SYMBOLS];
    uint16_t parent[2 * SYMBOLS], depth[2 * SYMBOLS];
    unsigned next_leaf = 0, next_node = 0;
    for (unsigned made = 0; made + 1 < count; made++) { // node i is number count + i
        weight[made] = 0;
        for (int child = 0; child < 2; child++) {
            bool take_leaf =
                next_leaf < count &&
                (next_node == made || leaves[next_leaf].frequency <= weight[next_node]);
            weight[made] += take_leaf ? leaves[next_leaf].frequency : weight[next_node];
            parent[take_leaf ? next_leaf++ : count + next_node++] = (uint16_t)(count + made);
        }
    }
    unsigned root = 2 * count - 2;
    depth[root] = 0;
    for (unsigned i = root; i-- > 0;) {
        depth[i] = (uint16_t)(depth[parent[i]] + 1);
        if (i < count)
            at[depth[i] < CODE_LENGTH ? depth[i] : CODE_LENGTH]++;
    }
}

// Codes cut to CODE_LENGTH take more than there is (Kraft): deepen others, the least first.
static void mend_lengths(unsigned at[CODE_LENGTH + 1])
{
    uint32_t taken = 0;
    for (int i = 1; i <= CODE_LENGTH; i++)
        taken += (uint32_t)at[i] << (CODE_LENGTH - i);
    for (; taken > 1u << CODE_LENGTH; taken--) { // one leaf moves down beside a deepest one
        int i = CODE_LENGTH - 1;
        while (!at[i])
            i--;
        at[i]--;
        at[i + 1] += 2;
        at[CODE_LENGTH]--;
    }
}

static uint16_t reversed(unsigned bits, unsigned count)
{
    unsigned out = 0;
    for (unsigned i = 0; i < count; i++)
        out |= (bits >> i & 1) << (count - 1 - i);
    return (uint16_t)out;
}

// RFC 1951, 3.2.2: the codes from their lengths.
static void fill_codes(codes *c, const unsigned at[CODE_LENGTH + 1])
{
    unsigned next[CODE_LENGTH + 1] = { 0 };
    for (int i = 1; i < CODE_LENGTH; i++)
        next[i + 1] = (next[i] + at[i]) << 1;
    for (int s = 0; s < SYMBOLS; s++)
        if (c->length[s])
            c->bits[s] = reversed(next[c->length[s]]++, c->length[s]);
}

static void make_codes(const uint32_t *frequency, codes *c)
{
    leaf leaves[SYMBOLS];
    unsigned count = 0, at[CODE_LENGTH + 1] = { 0 };
    for (unsigned s = 0; s < SYMBOLS; s++)
        if (frequency[s])
            leaves[count++] = (leaf) { frequency[s], (uint16_t)s };
    qsort(leaves, count, sizeof *leaves, compare_leaves);
    count_lengths(leaves, count, at);
    mend_lengths(at);
    memset(c, 0, sizeof *c);
    unsigned i = 0;
    for (unsigned length = CODE_LENGTH; length > 0; length--) // the rarest have the longest
        for (unsigned n = 0; n < at[length]; n++)
            c->length[leaves[i++].symbol] = (uint8_t)length;
    fill_codes(c, at);
}

// RFC 1951, 3.2.7, with the lengths as they are: each of the lengths 0 to 15 has the code
// of 4 bits that is itself, so that nothing has to be counted for some hundred bytes.
static void put_header(writer *w, const codes *c)
{
    static const uint8_t order[19] = { 16, 17, 18, 0, 8,  7, 9,  6, 10, 5,
                                       11, 4,  12, 3, 13, 2, 14, 1, 15 };
    put(w, 0, 1); // not the last block
    put(w, 2, 2); // dynamic codes
    put(w, SYMBOLS - 257, 5);
    put(w, 0, 5); // one distance code
    put(w, 19 - 4, 4);
    for (int i = 0; i < 19; i++)
        put(w, order[i] < 16 ? 4 : 0, 3);
    for (int s = 0; s < SYMBOLS; s++)
        put(w, reversed(c->length[s], 4), 4);
    put(w, reversed(1, 4), 4); // distance 1: a code of one bit, 0
}

static inline void add_token(writer *w, const codes *c, unsigned token)
{
    if (token < 256) {
        add(w, c->bits[token], c->length[token]);
        return;
    }
    length_code l = length_code_of(token - 256);
    add(w, c->bits[l.symbol], c->length[l.symbol]);
    add(w, l.extra, l.extra_bits + 1u); // and the distance's 0 behind it
}

// A token has at most 15 + 5 + 1 bits: two of them fit between flushes.
static void put_tokens(writer *to, const codes *c, const uint16_t *tokens, size_t count)
{
    writer w = *to;
    size_t i = 0;
    for (; i + 2 <= count; i += 2) {
        add_token(&w, c, tokens[i]);
        add_token(&w, c, tokens[i + 1]);
        flush(&w);
    }
    if (i < count)
        add_token(&w, c, tokens[i]);
    put(&w, c->bits[END], c->length[END]);
    *to = w;
}

size_t deflate_bound(size_t size)
{
    return 2 * size + 512; // 15 bits a byte, the header's 200 bytes
}

size_t deflate_runs(const uint8_t *data, size_t size, uint16_t *tokens, uint8_t *out)
{
    uint32_t frequency[SYMBOLS] = { 0 };
    size_t count = find_runs(data, size, tokens, frequency);
    codes c;
    if (count == 0) // a code needs two symbols
        frequency[0] = 1;
    make_codes(frequency, &c);
    writer w = { .out = out };
    put_header(&w, &c);
    put_tokens(&w, &c, tokens, count);
    put(&w, 0, 3); // an empty stored block comes to a whole byte
    put_rest(&w);
    memcpy(w.out, "\0\0\xff\xff", 4);
    return (size_t)(w.out - out) + 4;
}

size_t deflate_end(uint8_t *out)
{
    memcpy(out, "\1\0\0\xff\xff", 5);
    return 5;
}

static const uint32_t adler_base = 65521;

// Sixteen bytes at once, in a shape that compilers vectorise: b grows by 16 a and each
// byte as often as it has been added to a.
static void adler_block(const uint8_t *d, uint32_t *a, uint32_t *b)
{
    uint32_t sum = 0, weighted = 0;
    for (uint32_t i = 0; i < 16; i++) {
        sum += d[i];
        weighted += (16 - i) * d[i];
    }
    *b += 16 * *a + weighted;
    *a += sum;
}

uint32_t deflate_adler(uint32_t adler, const uint8_t *data, size_t size)
{
    uint32_t a = adler & 0xffff, b = adler >> 16;
    while (size) {
        size_t n = size < 5552 ? size : 5552; // as many as cannot overflow
        size_t i = 0;
        for (; i + 16 <= n; i += 16)
            adler_block(data + i, &a, &b);
        for (; i < n; i++) {
            a += data[i];
            b += a;
        }
        a %= adler_base;
        b %= adler_base;
        data += n;
        size -= n;
    }
    return b << 16 | a;
}

// a = 1 + sum of d, b = sum of all a on the way: the second piece's a began at 1, not at
// the first's, which its b has missed `size` times.
uint32_t deflate_adler_join(uint32_t first, uint32_t second, size_t size)
{
    uint64_t a1 = first & 0xffff, b1 = first >> 16, a2 = second & 0xffff, b2 = second >> 16;
    uint64_t n = size % adler_base, missed = a1 + adler_base - 1;
    uint64_t a = (missed + a2) % adler_base;
    uint64_t b = (b1 + b2 + n * (missed % adler_base)) % adler_base;
    return (uint32_t)(b << 16 | a);
}
