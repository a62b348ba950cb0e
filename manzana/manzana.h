/* manzana.h: manzana/view.h for C, and for what speaks C (Python's ctypes, plugins of GIS programs): libmanzana.so.
 *   manzana_error error;
 *   manzana_model* city = manzana_model_load("city.osm.pbf", NULL, NULL, NULL, &error);        a thread of the host's
 *   manzana_view* view = manzana_view_create(NULL, NULL);
 *   manzana_view_show(view, city);
 *   in the host's paint event, its context current, its framebuffer bound:
 *     manzana_view_update(view, &camera, 1, seconds, NULL, NULL);
 *     manzana_view_render(view, 0, &error);
 *   before the context goes:  manzana_view_release(view);
 *
 * Frames, units: a model's own frame, metres, x east, y north, z up at its anchor. Matrices are double, column by
 * column, as OpenGL has them: clip = projection * view * p. Angles are degrees. Strings are UTF-8. Threads:
 * manzana_view_show and manzana_view_show_nodes from any; all else of a view from one at a time. Models never change:
 * any thread may read. GL is called by render, pick, place and release, and what they find of its state they put back.
 * Errors: what may fail returns NULL or 0 and fills `error`, where that is not NULL. Nothing else fails. Lifetimes: who
 * gets a pointer from load or create frees it. A view keeps what it shows; its model may be freed. */
#ifndef MANZANA_H
#define MANZANA_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define MANZANA_API __attribute__((visibility("default")))

typedef struct manzana_model manzana_model;
typedef struct manzana_view manzana_view;

typedef struct manzana_error {
  char text[512]; /* one line */
} manzana_error;

MANZANA_API const char* manzana_version(void);

/* ---- models ---------------------------------------------------------------------------------------------------- */

typedef struct manzana_load_options {
  uint64_t seed;           /* of what is made up: scattered trees, cars */
  int32_t cars;            /* how many; -1: by the length of the streets */
  int32_t threads;         /* the calling one included */
  int32_t trees;           /* 0: none */
  int32_t attributes;      /* 0: what files say of things is not kept */
  const char* plant_cache; /* a folder where prepared plants are kept; NULL: they are not */
  const char* orthophoto;  /* a picture that is laid over the ground (GeoTIFF; in builds with GDAL); NULL: none */
} manzana_load_options;
MANZANA_API manzana_load_options manzana_load_defaults(void);

/* On the calling thread; fraction of a stage, 0 to 1. */
typedef void (*manzana_progress)(void* user, const char* stage, double fraction);

/* A file, or "builtin:town". options: NULL for the defaults. progress: may be NULL. */
MANZANA_API manzana_model* manzana_model_load(const char* city, const manzana_load_options* options,
                                              manzana_progress progress, void* user, manzana_error* error);
/* Bytes that the host has read; format: osm, osm.gz, osm.bz2 or pbf. */
MANZANA_API manzana_model* manzana_model_load_bytes(const void* bytes, size_t size, const char* format,
                                                    const char* name, const manzana_load_options* options,
                                                    manzana_progress progress, void* user, manzana_error* error);
MANZANA_API void manzana_model_free(manzana_model* model);

/* Must be shown with every picture, where it is not empty. Lives as long as the model. */
MANZANA_API const char* manzana_model_credits(const manzana_model* model);
MANZANA_API void manzana_model_bounds(const manzana_model* model, double low[3], double high[3]);
MANZANA_API void manzana_model_local_to_ecef(const manzana_model* model, double matrix[16]);
/* Latitude, longitude, height above the ellipsoid. 0 for a latitude that is none. */
MANZANA_API int manzana_model_to_local(const manzana_model* model, const double geo[3], double local[3]);
MANZANA_API void manzana_model_to_geo(const manzana_model* model, const double local[3], double geo[3]);

enum { MANZANA_BUILDING = 1, MANZANA_SURFACE = 2, MANZANA_TREE = 4 };
typedef struct manzana_feature {
  uint32_t id, kind;
  double low[3], high[3]; /* its box, local */
  double geo[3];          /* under its middle */
} manzana_feature;
MANZANA_API uint32_t manzana_model_features(const manzana_model* model); /* numbered from 1 */
MANZANA_API int manzana_model_feature(const manzana_model* model, uint32_t id, manzana_feature* feature);

/* What its file says of a feature: how many names with values; and the i-th, which live as long as the model. */
MANZANA_API uint32_t manzana_model_attributes(const manzana_model* model, uint32_t id);
MANZANA_API int manzana_model_attribute(const manzana_model* model, uint32_t id, uint32_t i, const char** name,
                                        const char** value);

/* ---- nodes: what a host puts into a city ------------------------------------------------------------------------- */

/* Planned buildings and whatever else stands or moves. They hang in trees: where one stands, whether it shows and its
 * colour hold for all below. A layer is a node without a mesh. A node's number is never given twice and no feature has
 * it; 0 is none. Placements are matrices in the parent's frame, without one local: affine, column by column. Changed by
 * the thread that updates, between frames; the host repaints. What fails changes nothing. */
typedef struct manzana_nodes manzana_nodes;
MANZANA_API manzana_nodes* manzana_nodes_create(const manzana_model* model);
MANZANA_API void manzana_nodes_free(manzana_nodes* nodes); /* views keep what they show */

/* A group or layer; name: may be NULL. */
MANZANA_API uint32_t manzana_nodes_add(manzana_nodes* nodes, uint32_t parent, const double placement[16],
                                       const char* name, manzana_error* error);
/* Of a glTF file (.gltf, .glb), with its hierarchy below the new node. */
MANZANA_API uint32_t manzana_nodes_add_model(manzana_nodes* nodes, const char* file, uint32_t parent,
                                             const double placement[16], manzana_error* error);
/* A second one of it and all below, with the same meshes. */
MANZANA_API uint32_t manzana_nodes_copy(manzana_nodes* nodes, uint32_t id, uint32_t parent, const double placement[16],
                                        manzana_error* error);
MANZANA_API int manzana_nodes_move(manzana_nodes* nodes, uint32_t id, const double placement[16], manzana_error* error);
MANZANA_API int manzana_nodes_hang(manzana_nodes* nodes, uint32_t id, uint32_t parent, manzana_error* error);
MANZANA_API int manzana_nodes_show(manzana_nodes* nodes, uint32_t id, int32_t shown, manzana_error* error);
/* 0xRRGGBB; -1: its own colours. */
MANZANA_API int manzana_nodes_paint(manzana_nodes* nodes, uint32_t id, int32_t colour, manzana_error* error);
MANZANA_API int manzana_nodes_remove(manzana_nodes* nodes, uint32_t id, manzana_error* error); /* and all below */

typedef struct manzana_node {
  uint32_t id, parent;
  int32_t visible;        /* it shows, and all above it */
  double low[3], high[3]; /* of it and all below, local; low > high without a mesh */
} manzana_node;
/* 0: there is none of that number. */
MANZANA_API int manzana_nodes_node(const manzana_nodes* nodes, uint32_t id, manzana_node* node);
/* A placement upright on the ground at a local place, turned from north to east, degrees. */
MANZANA_API void manzana_model_upright(const manzana_model* model, const double local[3], double turn,
                                       double placement[16]);

/* ---- views ------------------------------------------------------------------------------------------------------ */

typedef struct manzana_host {
  void* user;
  void (*log)(void* user, const char* line);           /* may be NULL */
  void (*request_repaint)(void* user);                 /* may be NULL; from the threads of show, render and tasks */
  void (*(*get_proc_address)(const char* name))(void); /* NULL: EGL's */
  /* Runs task(argument), once, on another thread of the host's: what far trees need is made there. A task may outlast
   * the view. NULL: threads of the view's own, which are there while far trees lack something. */
  void (*run)(void* user, void (*task)(void* argument), void* argument);
} manzana_host;

typedef struct manzana_view_options {
  uint64_t gpu_bytes;            /* a city that needs more is not shown; 0: no limit */
  uint64_t upload_bytes_a_frame; /* of one render */
  const char* quality;           /* "fast", "balanced", "accurate", "exact"; NULL: by the device */
  int32_t linear_framebuffer;    /* the host's encodes what is written (GL_FRAMEBUFFER_SRGB) */
} manzana_view_options;
MANZANA_API manzana_view_options manzana_view_defaults(void);

/* Both may be NULL. No GL. */
MANZANA_API manzana_view* manzana_view_create(const manzana_host* host, const manzana_view_options* options);
/* No GL: release it first, with the context current, or tell that the context is lost. */
MANZANA_API void manzana_view_free(manzana_view* view);

/* NULL: nothing. */
MANZANA_API void manzana_view_show(manzana_view* view, const manzana_model* model);
/* With what the host has put into it; a model that is shown already is not brought anew. */
MANZANA_API void manzana_view_show_nodes(manzana_view* view, const manzana_model* model, const manzana_nodes* nodes);

enum { MANZANA_DEPTH_MINUS_ONE_TO_ONE = 0, MANZANA_DEPTH_ZERO_TO_ONE = 1, MANZANA_DEPTH_REVERSED = 2 };
typedef struct manzana_camera {
  double projection[16], view[16];
  int32_t depth;
  int32_t x, y, width, height; /* of the framebuffer, pixels */
} manzana_camera;

typedef struct manzana_seen {
  uint64_t blocks, buildings, surfaces, trees, cars, nodes;
} manzana_seen;

typedef struct manzana_update {
  uint64_t bytes_to_upload; /* 0: all is there */
  uint64_t far_trees_left;  /* what far trees wait for */
  uint64_t pictures_left;   /* likewise what buildings wear, in mean colours until then */
  uint64_t gpu_bytes;
  int32_t shown; /* what is new starts hidden */
} manzana_update;

/* update: may be NULL. seen: NULL, or one for each camera. */
MANZANA_API void manzana_view_update(manzana_view* view, const manzana_camera* cameras, size_t count, double seconds,
                                     manzana_update* update, manzana_seen* seen);
MANZANA_API int manzana_view_render(manzana_view* view, size_t camera, manzana_error* error);
/* 1: the last render lacked nothing that was in sight. */
MANZANA_API int manzana_view_complete(const manzana_view* view);
/* width * height numbers of features and nodes, 0 for none; rows from the bottom, pixels of the viewport. */
MANZANA_API int manzana_view_pick(manzana_view* view, size_t camera, int32_t x, int32_t y, int32_t width,
                                  int32_t height, uint32_t* ids, manzana_error* error);

/* Where that is which stands in a pixel of the viewport, local. 0: nothing does. */
MANZANA_API int manzana_view_place(manzana_view* view, size_t camera, int32_t x, int32_t y, double local[3]);

typedef struct manzana_drawing {
  int32_t buildings, surfaces, trees, cars, sky, fog; /* layers: 0 or 1 */
  double sun[3];                                      /* towards it, local */
  double tree_error_px;                               /* what is smaller may be wrong; 0: by quality */
  double wind;                                        /* 0 to 1 */
} manzana_drawing;
MANZANA_API manzana_drawing manzana_view_drawing(const manzana_view* view);
MANZANA_API void manzana_view_set_drawing(manzana_view* view, const manzana_drawing* drawing);

/* Only these are found, counted, drawn and picked from now on: names as "building20 conifer", separated by spaces, of
 * building, building10, building20, building40 (at least so many metres), street, tree, tree15, broadleaf, conifer,
 * shrub, car, node. NULL: all. 0: a name that is none. */
MANZANA_API int manzana_view_show_only(manzana_view* view, const char* classes, manzana_error* error);
/* A building's colour, 0xRRGGBB; -1: its own. Asked for each, in render. NULL: all in their own again. */
typedef int32_t (*manzana_colour)(void* user, uint32_t feature);
MANZANA_API void manzana_view_colour_by(manzana_view* view, manzana_colour colour, void* user);

MANZANA_API void manzana_view_release(manzana_view* view);      /* with the context current */
MANZANA_API void manzana_view_context_lost(manzana_view* view); /* without */

#ifdef __cplusplus
}
#endif
#endif
