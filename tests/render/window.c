// Windows: what the display shows is what was drawn and laid over it.
#include <vulkan/vulkan.h>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include "screen.h"
#include "stage.h"

#include "physics/color.glsl"

#include <stdio.h>
#include <time.h>

enum { W = 160, H = 100, MOST = 2 * W }; // px; MOST: of any side

typedef struct fixture {
    ag_device *device; // first, as in kit.h
    ag_renderer *renderer;
    GLFWwindow *frame;
    ag_window *window;
    screen screen;
    char fault[64]; // the file for faults.c
} fixture;

typedef struct picture {
    uint32_t width, height;
    uint8_t px[MOST][MOST][4];
} picture;

static int create_surface(void *user, void *instance, void *surface)
{
    return glfwCreateWindowSurface(instance, user, NULL, surface);
}

static void quiet(void *user, ag_log_level level, const char *text)
{
    (void)level;
    snprintf(user, 256, "%s", text);
}

// ---- What is seen --------------------------------------------------------------

static int pixels_off(const fixture *f, const picture *wanted, int tolerance, bool print)
{
    int x, y, off = 0;
    glfwGetWindowPos(f->frame, &x, &y);
    for (uint32_t i = 0; i < wanted->width * wanted->height; i++) {
        uint32_t px = i % wanted->width, py = i / wanted->width;
        const uint8_t *want = wanted->px[py][px];
        uint8_t seen[3];
        screen_pixel(&f->screen, (uint32_t)x + px, (uint32_t)y + py, seen);
        bool differs = false;
        for (int c = 0; c < 3; c++)
            differs |= abs(seen[c] - want[c]) > tolerance;
        if (differs && !off && print)
            print_error("at %u, %u: %d %d %d, not %d %d %d\n", px, py, seen[0], seen[1], seen[2],
                        want[0], want[1], want[2]);
        off += differs;
    }
    return off;
}

// What was shown comes to the display by another thread: soon.
static void assert_seen(const fixture *f, const picture *wanted, int tolerance)
{
    const struct timespec pause = { 0, 2000000 };
    for (int i = 0; i < 5000; i++) {
        if (!pixels_off(f, wanted, tolerance, false))
            return;
        nanosleep(&pause, NULL);
    }
    assert_int_equal(pixels_off(f, wanted, tolerance, true), 0);
}

static void assert_unchanged(const fixture *f, const picture *wanted)
{
    const struct timespec pause = { 0, 50000000 };
    nanosleep(&pause, NULL);
    assert_int_equal(pixels_off(f, wanted, 0, true), 0);
}

static picture *plain(uint8_t r, uint8_t g, uint8_t b)
{
    static picture p;
    p.width = W;
    p.height = H;
    for (int y = 0; y < H; y++)
        for (int x = 0; x < W; x++)
            memcpy(p.px[y][x], (uint8_t[4]) { r, g, b, 255 }, 4);
    return &p;
}

// ---- What is shown -------------------------------------------------------------

// A wall whose colour is its place, and nothing behind it.
static ag_scene *wall(float alpha)
{
    const float colors[4][4] = { { 0, 0, 1, 1 }, { 1, 0, 0, 1 }, { 1, 1, 0, 1 }, { 0, 1, 0, 1 } };
    ag_scene *scene = stage_dark();
    ag_material_desc m = stage_unlit(1, 1, 1, alpha);
    if (alpha < 1)
        m.alpha_mode = AG_ALPHA_BLEND;
    stage_show(scene, stage_quad(scene, -1.03f, -0.83f, 1.03f, 0.83f, 0, colors), &m);
    return scene;
}

static ag_render_options sized(uint32_t width, uint32_t height)
{
    return (ag_render_options) { .width = width, .height = height, .tonemap = AG_TONEMAP_NONE };
}

static ag_image *rendered(const fixture *f, const ag_scene *scene, const ag_render_options *o)
{
    const ag_camera_desc camera = stage_flat_camera();
    ag_image *image;
    OK(ag_renderer_render(f->renderer, scene, &camera, o, &image, NULL));
    return image;
}

static ag_status show(const fixture *f, const ag_scene *scene, const ag_render_options *o,
                      const ag_layer *layers, uint32_t count)
{
    const ag_camera_desc camera = stage_flat_camera();
    int width, height;
    glfwPollEvents();
    glfwGetFramebufferSize(f->frame, &width, &height);
    const ag_show_options options = { .width = (uint32_t)width,
                                      .height = (uint32_t)height,
                                      .backdrop = { 0.2f, 0.4f, 0.6f },
                                      .layers = layers,
                                      .layer_count = count };
    return ag_window_show(f->window, scene, &camera, o, &options, NULL);
}

static uint8_t over_black(uint8_t code, uint8_t alpha)
{
    float light = color_srgb_decode_channel((float)code / 255) * (float)alpha / 255;
    return (uint8_t)(color_srgb_encode_channel(light) * 255 + 0.5f);
}

// Over black, mixed as light is: what a window shows of it.
static void take_picture(const ag_image *image, picture *p)
{
    p->width = ag_image_width(image);
    p->height = ag_image_height(image);
    for (uint32_t i = 0; i < p->width * p->height; i++) {
        const uint8_t *from = stage_byte(image, i % p->width, i / p->width);
        uint8_t *to = p->px[i / p->width][i % p->width];
        for (int c = 0; c < 3; c++)
            to[c] = from[3] == 255 ? from[c] : over_black(from[c], from[3]);
        to[3] = 255;
    }
}

static void assert_taken_back(const fixture *f, const ag_image *image)
{
    uint32_t width = ag_image_width(image), height = ag_image_height(image);
    ag_image *taken;
    OK(ag_window_picture(f->window, &taken));
    assert_int_equal(ag_image_width(taken), width);
    assert_int_equal(ag_image_height(taken), height);
    assert_memory_equal(stage_byte(taken, 0, 0), stage_byte(image, 0, 0), 4ul * width * height);
    ag_image_destroy(taken);
}

// ---- Pictures --------------------------------------------------------------------

static void a_window_shows_what_the_renderer_gives(void **state)
{
    static picture wanted;
    const fixture *f = *state;
    for (int i = 0; i < 8; i++) {
        ag_scene *scene = wall(i & 1 ? 0.5f : 1); // blended: forward
        ag_render_options o = sized(W, H);
        o.quality = i & 2 ? AG_QUALITY_FAST : AG_QUALITY_DEFAULT;
        o.background = i & 4 ? AG_BACKGROUND_TRANSPARENT : AG_BACKGROUND_COLOR;
        o.background_color[1] = 0.5f;
        ag_image *image = rendered(f, scene, &o);
        take_picture(image, &wanted);
        OK(show(f, scene, &o, NULL, 0));
        assert_seen(f, &wanted, i & 4 ? 1 : 0);
        assert_taken_back(f, image);
        ag_image_destroy(image);
        ag_scene_destroy(scene);
    }
}

static void bloom_is_shown(void **state)
{
    static picture wanted;
    const fixture *f = *state;
    ag_scene *scene = wall(1);
    ag_render_options o = sized(W, H);
    o.bloom = 0.3f;
    ag_image *image = rendered(f, scene, &o);
    take_picture(image, &wanted);
    OK(show(f, scene, &o, NULL, 0));
    assert_seen(f, &wanted, 0);
    assert_taken_back(f, image);
    ag_image_destroy(image);
    ag_scene_destroy(scene);
}

// Half as large: each pixel is the mean of four.
static void pictures_are_scaled(void **state)
{
    static picture wanted = { .width = W, .height = H };
    const fixture *f = *state;
    ag_scene *scene = wall(1);
    const ag_render_options o = sized(2 * W, 2 * H);
    ag_image *image = rendered(f, scene, &o);
    for (uint32_t y = 0; y < H; y++)
        for (uint32_t x = 0; x < W; x++)
            for (int c = 0; c < 3; c++) {
                int sum = 2;
                for (uint32_t i = 0; i < 4; i++)
                    sum += stage_byte(image, 2 * x + i % 2, 2 * y + i / 2)[c];
                wanted.px[y][x][c] = (uint8_t)(sum / 4);
            }
    OK(show(f, scene, &o, NULL, 0));
    assert_seen(f, &wanted, 1);
    ag_image_destroy(image);
    ag_scene_destroy(scene);
}

// Sixteen texels a pixel, of which the middle two are mixed; on a CPU in two tiles.
static void tiles_join(void **state)
{
    enum { N = 16 };
    static picture wanted = { .width = W, .height = H };
    const fixture *f = *state;
    for (int i = 0; i < 2; i++) {
        ag_scene *scene = wall(i ? 0.5f : 1);
        const ag_render_options o = sized(N * W, H);
        const ag_camera_desc camera = stage_flat_camera();
        ag_render_stats stats;
        ag_image *image;
        OK(ag_renderer_render(f->renderer, scene, &camera, &o, &image, &stats));
        if (ag_device_describe(f->device)->kind == AG_DEVICE_CPU)
            assert_in_range(stats.tiles, 2, 16);
        for (uint32_t y = 0; y < H; y++)
            for (uint32_t x = 0; x < W; x++)
                for (int c = 0; c < 3; c++)
                    wanted.px[y][x][c] = (uint8_t)((stage_byte(image, N * x + N / 2 - 1, y)[c] +
                                                    stage_byte(image, N * x + N / 2, y)[c] + 1) /
                                                   2);
        OK(show(f, scene, &o, NULL, 0));
        assert_seen(f, &wanted, 1);
        ag_image_destroy(image);
        ag_scene_destroy(scene);
    }
}

static void the_last_picture_stays(void **state)
{
    static picture wanted;
    const fixture *f = *state;
    ag_scene *scene = wall(1);
    const ag_render_options o = sized(W, H);
    ag_image *image = rendered(f, scene, &o);
    take_picture(image, &wanted);
    OK(show(f, scene, &o, NULL, 0));
    ag_scene_destroy(scene); // no longer needed
    const uint8_t red[4] = { 255, 0, 0, 255 };
    const ag_image_desc desc = { 1, 1, AG_FORMAT_RGBA8, red };
    ag_image *dot;
    OK(ag_image_create(NULL, &desc, &dot));
    const ag_layer layer = { .image = dot, .x = 7, .y = 5 };
    OK(show(f, NULL, NULL, &layer, 1));
    memcpy(wanted.px[5][7], red, 4);
    assert_seen(f, &wanted, 0);
    assert_taken_back(f, image); // without it
    OK(show(f, NULL, NULL, NULL, 0));
    memcpy(wanted.px[5][7], stage_byte(image, 7, 5), 4);
    assert_seen(f, &wanted, 0);
    ag_image_destroy(dot);
    ag_image_destroy(image);
}

// ---- Layers ----------------------------------------------------------------------

static uint32_t random_word(uint32_t *state)
{
    *state = *state * 747796405u + 2891336453u;
    return *state >> 8;
}

static ag_image *noise(uint32_t width, uint32_t height, uint32_t seed)
{
    static uint8_t px[64 * 64][4];
    for (uint32_t i = 0; i < width * height; i++)
        for (int c = 0; c < 4; c++)
            px[i][c] = (uint8_t)random_word(&seed);
    const ag_image_desc desc = { width, height, AG_FORMAT_RGBA8, px };
    ag_image *image;
    OK(ag_image_create(NULL, &desc, &image));
    return image;
}

// The image at u, v in its texels, mixed of the nearest four.
static void filtered(const ag_image *image, double u, double v, double color[4])
{
    const int w = (int)ag_image_width(image), h = (int)ag_image_height(image);
    const int left = (int)floor(u - 0.5), top = (int)floor(v - 0.5);
    const double a = u - 0.5 - left, b = v - 0.5 - top;
    memset(color, 0, sizeof(double[4]));
    for (int i = 0; i < 4; i++) {
        int x = left + i % 2, y = top + i / 2;
        x = x < 0 ? 0 : x < w ? x : w - 1;
        y = y < 0 ? 0 : y < h ? y : h - 1;
        const uint8_t *texel = stage_byte(image, (uint32_t)x, (uint32_t)y);
        for (int c = 0; c < 4; c++)
            color[c] += texel[c] * (i % 2 ? a : 1 - a) * (i / 2 ? b : 1 - b);
    }
}

static bool within(const double box[4], double x, double y)
{
    return x >= box[0] && x < box[2] && y >= box[1] && y < box[3];
}

static void lay_over(picture *p, const ag_layer *l)
{
    const double iw = ag_image_width(l->image), ih = ag_image_height(l->image);
    const double left = (double)l->x, top = (double)l->y;
    const double width = l->width > 0 ? (double)l->width : iw;
    const double height = l->height > 0 ? (double)l->height : ih;
    const double place[4] = { left, top, left + width, top + height };
    double clip[4];
    for (int i = 0; i < 4; i++)
        clip[i] = floor((double)l->clip[i]); // whole pixels
    const bool clipped = clip[2] > 0;
    for (int i = 0; i < W * H; i++) {
        const double x = i % W + 0.5, y = i / W + 0.5;
        double color[4];
        if (!within(place, x, y) || (clipped && !within(clip, x, y)))
            continue;
        filtered(l->image, (x - left) / width * iw, (y - top) / height * ih, color);
        uint8_t *px = p->px[i / W][i % W];
        for (int c = 0; c < 3; c++)
            px[c] = (uint8_t)(color[c] * color[3] / 255 + px[c] * (1 - color[3] / 255) + 0.5);
    }
}

static void layers_lie_where_they_are_told(void **state)
{
    const fixture *f = *state;
    ag_scene *scene = wall(1);
    ag_image *a = noise(40, 30, 1), *b = noise(13, 7, 2);
    const ag_layer layers[] = {
        { .image = a, .x = 10, .y = 20 },
        { .image = b, .x = 30, .y = 10, .width = 52, .height = 35 }, // larger, over the first
        { .image = NULL },
        { .image = a, .x = -15, .y = -12 },                                     // cut by the window
        { .image = a, .x = 140, .y = 90, .clip = { 145, 92, 400, 400 } },       // by both
        { .image = a, .x = 100, .y = 40, .clip = { 110.9f, 45, 120.2f, 60 } },  // by a box
        { .image = b, .x = 60, .y = 60, .clip = { 30, 30, 20, 20 } },           // nothing is left
        { .image = b, .x = 60.25f, .y = 80.5f, .width = 6.5f, .height = 3.5f }, // smaller
        { .image = a, .x = 1e9f, .y = -1e9f },
    };
    const ag_render_options o = sized(W, H);
    static picture wanted;
    ag_image *image = rendered(f, scene, &o);
    take_picture(image, &wanted);
    for (size_t i = 0; i < sizeof layers / sizeof *layers; i++)
        if (layers[i].image)
            lay_over(&wanted, &layers[i]);
    OK(show(f, scene, &o, layers, sizeof layers / sizeof *layers));
    assert_seen(f, &wanted, 2);
    ag_image_destroy(image);
    ag_image_destroy(b);
    ag_image_destroy(a);
    ag_scene_destroy(scene);
}

// 16 of one pixel each; the same version: not brought again.
static void layers_keep_their_version(void **state)
{
    const fixture *f = *state;
    static picture wanted;
    ag_layer layers[AG_LAYERS_MAX];
    for (int round = 0; round < 4; round++) {
        ag_scene *scene = stage_dark(); // nothing of it is seen
        const ag_render_options o = sized(W, H);
        OK(show(f, scene, &o, NULL, 0));
        wanted = *plain(0, 0, 0);
        for (int i = 0; i < AG_LAYERS_MAX; i++) {
            const uint8_t px[4] = { (uint8_t)(50 * round + i), 77, 200, 255 };
            const ag_image_desc desc = { 1, 1, AG_FORMAT_RGBA8, px };
            ag_image *image;
            OK(ag_image_create(NULL, &desc, &image));
            // The first half never changes, the others do with every second round.
            uint64_t version = i < AG_LAYERS_MAX / 2 ? 5 : 5 + (uint64_t)round / 2;
            layers[i] = (ag_layer) { .image = image, .x = (float)i, .version = version };
            int of = i < AG_LAYERS_MAX / 2 ? 0 : round / 2 * 2;
            wanted.px[0][i][0] = (uint8_t)(50 * of + i);
            wanted.px[0][i][1] = 77;
            wanted.px[0][i][2] = 200;
        }
        OK(show(f, NULL, NULL, layers, AG_LAYERS_MAX));
        assert_seen(f, &wanted, 0);
        for (int i = 0; i < AG_LAYERS_MAX; i++)
            ag_image_destroy((ag_image *)(uintptr_t)layers[i].image);
        ag_scene_destroy(scene);
    }
}

// ---- What is refused ---------------------------------------------------------------

static int open_fixture(fixture *f);
static void close_fixture(fixture *f);

static void what_cannot_be_shown_is_refused(void **state)
{
    char said[256] = "";
    const ag_log log = { .write = quiet, .user = said };
    const ag_device_desc desc = { .log = &log, .select = "cpu", .validate = true, .windows = true };
    fixture f = *(fixture *)*state;
    const ag_window_desc window = { .create_surface = create_surface, .user = f.frame };
    ag_window_destroy(((fixture *)*state)->window); // one at a time has a surface
    OK(ag_device_create(&desc, &f.device));
    OK(ag_renderer_create(f.device, &f.renderer));
    OK(ag_window_create(f.renderer, &window, &f.window));
    ag_image *image = noise(3, 3, 1), *linear;
    const ag_image_desc light = { 2, 2, AG_FORMAT_RGBA32F, NULL };
    OK(ag_image_create(NULL, &light, &linear));
    ag_layer layers[AG_LAYERS_MAX + 1];
    for (int i = 0; i <= AG_LAYERS_MAX; i++)
        layers[i] = (ag_layer) { .image = image };
    assert_int_equal(show(&f, NULL, NULL, layers, AG_LAYERS_MAX + 1), AG_ERROR_ARGUMENT);
    assert_non_null(strstr(said, "17 layers"));
    layers[1].image = linear;
    assert_int_equal(show(&f, NULL, NULL, layers, 2), AG_ERROR_ARGUMENT);
    assert_non_null(strstr(said, "layer 1"));
    ag_scene *scene = wall(1);
    const ag_render_options huge = sized(ag_device_describe(f.device)->max_size + 1, 1);
    assert_int_equal(show(&f, scene, &huge, NULL, 0), AG_ERROR_ARGUMENT);
    OK(show(&f, NULL, NULL, NULL, 0)); // goes on, with nothing to show
    assert_seen(&f, plain(51, 102, 153), 0);
    assert_int_equal(ag_device_validation_messages(f.device), 0);
    ag_scene_destroy(scene);
    ag_image_destroy(linear);
    ag_image_destroy(image);
    ag_window_destroy(f.window);
    ag_renderer_destroy(f.renderer);
    ag_device_destroy(f.device);
    fixture *shared = *state;
    OK(ag_window_create(shared->renderer, &window, &shared->window));
}

static int no_surface(void *user, void *instance, void *surface)
{
    (void)instance;
    (void)surface;
    (*(int *)user)++;
    return -9; // VK_ERROR_INCOMPATIBLE_DRIVER
}

static void surfaces_may_fail(void **state)
{
    char said[256] = "";
    const ag_log log = { .write = quiet, .user = said };
    const fixture *f = *state;
    for (int windows = 0; windows < 2; windows++) {
        const ag_device_desc desc = { .log = &log, .select = "cpu", .windows = windows };
        ag_device *device;
        ag_renderer *renderer;
        ag_window *window = f->window;
        int calls = 0;
        OK(ag_device_create(&desc, &device));
        OK(ag_renderer_create(device, &renderer));
        const ag_window_desc way = { .create_surface = no_surface, .user = &calls };
        assert_int_equal(ag_window_create(renderer, &way, &window),
                         windows ? AG_ERROR_DEVICE : AG_ERROR_ARGUMENT);
        assert_null(window);
        assert_int_equal(calls, windows);
        assert_non_null(strstr(said, windows ? "Vulkan code -9" : "not opened for windows"));
        ag_renderer_destroy(renderer);
        ag_device_destroy(device);
    }
}

// ---- Sizes -------------------------------------------------------------------------

static void nothing_is_done_for_a_window_without_area(void **state)
{
    const fixture *f = *state;
    ag_scene *red = wall(1);
    const ag_render_options o = sized(W, H);
    OK(show(f, red, &o, NULL, 0));
    static picture wanted;
    ag_image *image = rendered(f, red, &o);
    take_picture(image, &wanted);
    assert_seen(f, &wanted, 0);
    ag_scene *dark = stage_dark();
    for (uint32_t i = 0; i < 3; i++) {
        const ag_show_options none = { .width = i == 1 ? W : 0, .height = i == 2 ? H : 0 };
        ag_render_stats stats = { .draws = 7 };
        OK(ag_window_show(f->window, dark, NULL, &o, &none, &stats));
        assert_int_equal(stats.draws, 0);
    }
    assert_unchanged(f, &wanted);
    ag_image_destroy(image);
    ag_scene_destroy(dark);
    ag_scene_destroy(red);
}

static void resize(const fixture *f, int width, int height)
{
    int w = 0, h = 0;
    glfwSetWindowSize(f->frame, width, height);
    for (int i = 0; i < 2000 && (w != width || h != height); i++) {
        glfwWaitEventsTimeout(0.005);
        glfwGetFramebufferSize(f->frame, &w, &h);
    }
    assert_int_equal(w, width);
    assert_int_equal(h, height);
}

// The size that is told is now and then the one before: the window changes meanwhile.
static void windows_change_their_size(void **state)
{
    static picture wanted;
    const fixture *f = *state;
    ag_scene *scene = wall(1);
    for (int i = 0; i < 50; i++) {
        ag_render_options o = sized((uint32_t)(W + i), H);
        glfwSetWindowSize(f->frame, i % 7 ? W - 3 * i : 1, i % 5 ? H - i : 1);
        OK(show(f, scene, &o, NULL, 0));
    }
    resize(f, W, H);
    const ag_render_options o = sized(W, H);
    ag_image *image = rendered(f, scene, &o);
    take_picture(image, &wanted);
    OK(show(f, scene, &o, NULL, 0));
    assert_seen(f, &wanted, 0);
    ag_image_destroy(image);
    ag_scene_destroy(scene);
}

// ---- Faults ------------------------------------------------------------------------

static void make_fail(const fixture *f, const char *call, VkResult code)
{
    FILE *file = fopen(f->fault, "w");
    assert_non_null(file);
    fprintf(file, "%s %d\n", call, (int)code);
    assert_int_equal(fclose(file), 0);
}

static bool has_failed(const fixture *f)
{
    return access(f->fault, F_OK) != 0;
}

static void what_is_out_of_date_is_made_anew(void **state)
{
    static const struct {
        const char *call;
        VkResult code;
    } faults[] = { { "vkAcquireNextImageKHR", VK_ERROR_OUT_OF_DATE_KHR },
                   { "vkAcquireNextImageKHR", VK_TIMEOUT },
                   { "vkQueuePresentKHR", VK_ERROR_OUT_OF_DATE_KHR },
                   { "vkQueuePresentKHR", VK_SUBOPTIMAL_KHR } };
    const fixture *f = *state;
    for (size_t i = 0; i < sizeof faults / sizeof *faults; i++) {
        static picture wanted;
        ag_scene *scene = wall(i % 2 ? 0.5f : 1);
        const ag_render_options o = sized(W, H);
        ag_image *image = rendered(f, scene, &o);
        make_fail(f, faults[i].call, faults[i].code);
        OK(show(f, scene, &o, NULL, 0));
        assert_true(has_failed(f));
        OK(show(f, NULL, NULL, NULL, 0));
        take_picture(image, &wanted);
        assert_seen(f, &wanted, 0);
        ag_image_destroy(image);
        ag_scene_destroy(scene);
    }
}

static void fail_of_memory(const fixture *f, const ag_scene *scene, const ag_render_options *o,
                           const ag_layer *layer)
{
    make_fail(f, "vkQueueSubmit2", VK_ERROR_OUT_OF_DEVICE_MEMORY);
    assert_int_equal(show(f, scene, o, layer, layer ? 1 : 0), AG_ERROR_MEMORY);
    assert_true(has_failed(f));
}

// What a submission that failed was to do is done by the next one.
static void memory_may_be_short(void **state)
{
    static picture wanted;
    const fixture *f = *state;
    ag_scene *scene = wall(1);
    const ag_render_options small = sized(W - 8, H - 8), o = sized(W, H); // small: a new image
    ag_image *image = rendered(f, scene, &small), *taken;
    fail_of_memory(f, scene, &small, NULL);
    assert_int_equal(ag_window_picture(f->window, &taken), AG_ERROR_ARGUMENT);
    OK(show(f, scene, &small, NULL, 0));
    assert_taken_back(f, image);
    ag_image_destroy(image);

    image = rendered(f, scene, &o);
    take_picture(image, &wanted);
    memcpy(wanted.px[5][7], (uint8_t[4]) { 255, 0, 0, 255 }, 4);
    const ag_image_desc desc = { 1, 1, AG_FORMAT_RGBA8, wanted.px[5][7] };
    ag_image *dot;
    OK(ag_image_create(NULL, &desc, &dot));
    const ag_layer layer = { .image = dot, .x = 7, .y = 5, .version = 77 };
    OK(show(f, scene, &o, NULL, 0));
    fail_of_memory(f, NULL, NULL, &layer);
    OK(show(f, NULL, NULL, &layer, 1));
    assert_seen(f, &wanted, 0);
    ag_image_destroy(image);
    ag_image_destroy(dot);
    ag_scene_destroy(scene);
}

// AG_ERROR_DEVICE, everything goes, and a new device shows what the old one did.
static void devices_and_windows_may_be_lost(void **state)
{
    static const struct {
        const char *call;
        VkResult code;
        bool picture; // the scene is drawn, too
    } faults[] = { { "vkQueueSubmit2", VK_ERROR_DEVICE_LOST, true },
                   { "vkQueueSubmit2", VK_ERROR_DEVICE_LOST, false },
                   { "vkAcquireNextImageKHR", VK_ERROR_SURFACE_LOST_KHR, false },
                   { "vkQueuePresentKHR", VK_ERROR_SURFACE_LOST_KHR, false },
                   { "vkQueuePresentKHR", VK_ERROR_DEVICE_LOST, true } };
    fixture *f = *state;
    for (size_t i = 0; i < sizeof faults / sizeof *faults; i++) {
        static picture wanted;
        ag_scene *scene = wall(1);
        const ag_render_options o = sized(W, H);
        OK(show(f, scene, &o, NULL, 0));
        make_fail(f, faults[i].call, faults[i].code);
        assert_int_equal(show(f, faults[i].picture ? scene : NULL, &o, NULL, 0), AG_ERROR_DEVICE);
        assert_true(has_failed(f));
        assert_int_equal(ag_device_validation_messages(f->device), 0);
        close_fixture(f);
        assert_int_equal(open_fixture(f), 0);
        ag_image *image = rendered(f, scene, &o);
        take_picture(image, &wanted);
        OK(show(f, scene, &o, NULL, 0));
        assert_seen(f, &wanted, 0);
        ag_image_destroy(image);
        ag_scene_destroy(scene);
    }
}

// ---- The fixture -------------------------------------------------------------------

static int open_fixture(fixture *f)
{
    const char *select = getenv("ARGAND_TEST_DEVICE");
    const ag_device_desc desc = { .select = select ? select : "cpu",
                                  .validate = true,
                                  .windows = true };
    const ag_window_desc window = { .create_surface = create_surface, .user = f->frame };
    if (ag_device_create(&desc, &f->device) || ag_renderer_create(f->device, &f->renderer) ||
        ag_window_create(f->renderer, &window, &f->window))
        return -1;
    return 0;
}

static void close_fixture(fixture *f)
{
    ag_window_destroy(f->window);
    ag_renderer_destroy(f->renderer);
    ag_device_destroy(f->device);
    f->window = NULL;
    f->renderer = NULL;
    f->device = NULL;
}

static int open_all(void **state)
{
    static fixture f;
    *state = &f;
    if (!glfwInit() || !screen_open(&f.screen)) {
        print_error("no display: run by tests/with_display.sh\n");
        return -1;
    }
    snprintf(f.fault, sizeof f.fault, "/tmp/argand-fault-%d", (int)getpid());
    setenv("ARGAND_TEST_FAULT", f.fault, 1);
    glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
    glfwWindowHint(GLFW_DECORATED, GLFW_FALSE);
    f.frame = glfwCreateWindow(W, H, "argand", NULL, NULL);
    return f.frame ? open_fixture(&f) : -1;
}

static int close_all(void **state)
{
    fixture *f = *state;
    close_fixture(f);
    unlink(f->fault);
    glfwDestroyWindow(f->frame);
    glfwTerminate();
    screen_close(&f->screen);
    return 0;
}

static int check(void **state)
{
    return kit_check((void **)*state); // the device is the fixture's first member
}

#define WINDOW_TEST(function) cmocka_unit_test_setup_teardown(function, NULL, check)

int main(void)
{
    const struct CMUnitTest tests[] = {
        WINDOW_TEST(a_window_shows_what_the_renderer_gives),
        WINDOW_TEST(bloom_is_shown),
        WINDOW_TEST(pictures_are_scaled),
        WINDOW_TEST(tiles_join),
        WINDOW_TEST(the_last_picture_stays),
        WINDOW_TEST(layers_lie_where_they_are_told),
        WINDOW_TEST(layers_keep_their_version),
        WINDOW_TEST(what_cannot_be_shown_is_refused),
        WINDOW_TEST(surfaces_may_fail),
        WINDOW_TEST(nothing_is_done_for_a_window_without_area),
        WINDOW_TEST(windows_change_their_size),
        WINDOW_TEST(what_is_out_of_date_is_made_anew),
        WINDOW_TEST(memory_may_be_short),
        WINDOW_TEST(devices_and_windows_may_be_lost),
    };
    return cmocka_run_group_tests_name("window", tests, open_all, close_all);
}
