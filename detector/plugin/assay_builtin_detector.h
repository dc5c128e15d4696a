/* The built-in detector in C: for programs in C, and for those that take any detector by the
 * interface of assay_detector.h. C99 or C++; link assay::detector.
 *
 *   assay_builtin_options options = ASSAY_BUILTIN_DEFAULTS;
 *   assay_builtin_error error;
 *   assay_handle* handle = NULL;
 *   if (assay_builtin_create(triangles, m, positions, n, &options, &handle, &error) != ASSAY_OK)
 *     return report(error.message);
 *
 * The table below and the functions after it serve the same handles, and keep the rules on memory,
 * threads and order of assay_detector.h. The functions do what the table does, with more to choose
 * and with named errors, and save and restore the state that is carried from step to step.
 *
 * ERRORS. Each function returns ASSAY_OK, ASSAY_REFUSED or ASSAY_OUT_OF_MEMORY. A call that is not
 * ASSAY_OK has changed nothing, but that a failed evaluate leaves nothing to commit. `error` may be
 * NULL; else it is filled in, with ASSAY_OK by ASSAY_BUILTIN_NO_ERROR and an empty message. Handles
 * and arrays must not be NULL where nothing else is said. */
#ifndef ASSAY_BUILTIN_DETECTOR_H
#define ASSAY_BUILTIN_DETECTOR_H

#include "detector/plugin/assay_detector.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The built-in detector as any other, with the default options. Never NULL; valid for ever. */
const assay_detector_api* assay_builtin_detector(void);

/* What may be wrong. The numbers stay: new ones are added behind. */
enum {
  ASSAY_BUILTIN_NO_ERROR = 0,
  ASSAY_BUILTIN_NO_TRIANGLES = 1,          /* an empty mesh */
  ASSAY_BUILTIN_INDEX_OUT_OF_RANGE = 2,    /* a triangle names a vertex that does not exist */
  ASSAY_BUILTIN_REPEATED_INDEX = 3,        /* a triangle names one vertex twice */
  ASSAY_BUILTIN_SAME_VERTICES_TWICE = 4,   /* two triangles have the same three vertices */
  ASSAY_BUILTIN_WRONG_FRAME_SIZE = 5,      /* (not met in C: arrays carry no size) */
  ASSAY_BUILTIN_NON_FINITE_COORDINATE = 6, /* NaN or infinity, also in a view primitive */
  ASSAY_BUILTIN_WRONG_PRIMITIVE_COUNT = 7, /* none, one, or one for each component */
  ASSAY_BUILTIN_NOTHING_TO_COMMIT = 8,     /* no step with an answer was evaluated */
  ASSAY_BUILTIN_FOREIGN_STATE = 9,         /* saved of another mesh or with another culling */
  ASSAY_BUILTIN_DAMAGED_STATE = 10,        /* no saved state, or one that was cut or changed */
  ASSAY_BUILTIN_OTHER_STATE_VERSION = 11,  /* saved in a form that this build does not read */
  ASSAY_BUILTIN_MESH_TOO_LARGE = 12,       /* more triangles or vertices than indices can number */
  ASSAY_BUILTIN_STOPPED = 13,              /* (not met in C: create takes no stop function) */
  ASSAY_BUILTIN_WRONG_OPTIONS = 64,        /* an option has no such value; struct_size is wrong */
  ASSAY_BUILTIN_SMALL_BUFFER = 65,         /* the state takes more bytes */
  ASSAY_BUILTIN_TOO_MANY = 66,             /* more than 2^31 - 1 triangles or vertices */
  ASSAY_BUILTIN_NO_MEMORY = 67
};

/* "index_out_of_range"; "unknown_error" for a number that is none of them. Static text. */
const char* assay_builtin_error_name(int32_t code);

/* The caller's own. */
typedef struct assay_builtin_error {
  int32_t code;      /* ASSAY_BUILTIN_... */
  char message[252]; /* one line for a user, cut where it is longer; ends with 0 */
} assay_builtin_error;

/* Options. The default is ASSAY_CULLING_AUTO, and 0 in each other. */
enum {
  ASSAY_CULLING_VIEW_AUTO = 0,  /* a point or a segment, whichever sees more; bvh where that does
                                   not pay */
  ASSAY_CULLING_VIEW_POINT = 1, /* each component seen from a point */
  ASSAY_CULLING_VIEW_LINE = 2,  /* each component seen from a segment */
  ASSAY_CULLING_NORMAL_CONE = 3,
  ASSAY_CULLING_BVH = 4,
  ASSAY_CULLING_NONE = 5, /* every pair, no boxes */
  ASSAY_CULLING_AUTO = 6  /* the first and normal cones in one descent, each where it pays */
};
enum {
  ASSAY_START_VERIFIED = 0, /* what is clean is found out at each new start */
  ASSAY_START_CLEAN = 1,    /* the caller vouches that nothing is in contact, layers are common */
  ASSAY_START_UNKNOWN = 2   /* everything is dirty */
};
enum {
  ASSAY_PAIRS_ALL = 0,  /* the complete pair set of the step */
  ASSAY_PAIRS_FIRST = 1 /* the first contact time, and pairs that may not be all */
};
enum {
  ASSAY_ARITHMETIC_EXACT = 0,
  ASSAY_ARITHMETIC_BOUNDED = 1, /* never a miss, some false alarms */
  ASSAY_ARITHMETIC_DOUBLE = 2,  /* no promise: made to be measured */
  ASSAY_ARITHMETIC_FLOAT = 3    /* likewise */
};
enum {
  ASSAY_RELEASE_PIECES = 0, /* dirty triangles become clean piece by piece */
  ASSAY_RELEASE_MODEL = 1,  /* a component at once, when all its pieces may be */
  ASSAY_RELEASE_VIEW = 2    /* a component at once, when it is all positive from inside */
};
enum {
  ASSAY_GHOST_TEST_EXACT = 0, /* violated: what a ghost touches */
  ASSAY_GHOST_TEST_BOXES = 1  /* what a ghost's moving box is not apart from */
};

typedef struct assay_builtin_options {
  uint32_t struct_size; /* sizeof(assay_builtin_options): members may be added behind */
  int32_t culling;      /* ASSAY_CULLING_... */
  int32_t start;        /* ASSAY_START_... */
  int32_t pairs;        /* ASSAY_PAIRS_... */
  int32_t arithmetic;   /* ASSAY_ARITHMETIC_... */
  int32_t release;      /* ASSAY_RELEASE_... */
  int32_t ghost_test;   /* ASSAY_GHOST_TEST_... */
  uint32_t threads;     /* that it may use, with equal results; 0: as many as the machine has */
} assay_builtin_options;

#define ASSAY_BUILTIN_DEFAULTS \
  { sizeof(assay_builtin_options), ASSAY_CULLING_AUTO, 0, 0, 0, 0, 0, 1 }

/* As the table's create. options: NULL for the defaults. *handle is left alone unless ASSAY_OK. */
int32_t assay_builtin_create(const int32_t* triangles, uint64_t triangle_count,
                             const double* positions, uint64_t vertex_count,
                             const assay_builtin_options* options, assay_handle** handle,
                             assay_builtin_error* error);

/* Where the mesh is viewed from, in place of the detector's own choice: a segment of two ends, each
 * with its place at t = 0 and at t = 1. Equal ends are a point. It may be anywhere. */
typedef struct assay_view_primitive {
  double q0_t0[3], q0_t1[3], q1_t0[3], q1_t1[3];
} assay_view_primitive;

/* As the table's evaluate, then result() tells the answer. primitive_count: 0 (the detector's own),
 * 1 for all components, or one for each, ordered by their lowest vertex. stop: called now and then
 * with stop_data; not 0 ends the work with answer ASSAY_UNDECIDED; may be NULL. */
int32_t assay_builtin_evaluate(assay_handle* handle, const double* x_t0, const double* x_t1,
                               const assay_view_primitive* primitives, uint64_t primitive_count,
                               int32_t (*stop)(void* stop_data), void* stop_data,
                               assay_builtin_error* error);

/* As the table's commit. */
int32_t assay_builtin_commit(assay_handle* handle, assay_builtin_error* error);

/* Of the step evaluated last. Where it used no views all sizes are 0 and doubts is NULL. */
typedef struct assay_builtin_sets {
  uint64_t view_positive, view_negative, view_zero; /* sizes of V+, V-, V0, each without Vv */
  uint64_t against_all;  /* size of Vv: violated or dirty; the four are all triangles */
  uint64_t violated;     /* touched by a ghost during the step */
  uint64_t dirty;        /* carry doubt into the step */
  const uint8_t* doubts; /* by triangle, bit 0: violated, bit 1: dirty; the detector's own */
} assay_builtin_sets;
void assay_builtin_get_sets(const assay_handle* handle, assay_builtin_sets* sets);

/* Forgets the committed steps: the next one is a new start. Keeps what result() tells. */
void assay_builtin_reset(assay_handle* handle);

/* The committed state as bytes, the same on every machine, to be kept or sent. *size: set to the
 * bytes that it takes, in any case. Call with buffer NULL and capacity 0 to learn it; a buffer of
 * less is refused and not written to. */
int32_t assay_builtin_save(const assay_handle* handle, void* buffer, uint64_t capacity,
                           uint64_t* size, assay_builtin_error* error);

/* Goes on from a saved state: answers, times and pairs are those of the handle that was saved, in
 * every bit; view sets too, where both were created from the same positions. What was evaluated and
 * not committed is dropped. The handle must be of the same mesh and culling. Damage is noticed; the
 * bytes are not protected against forgery. */
int32_t assay_builtin_restore(assay_handle* handle, const void* bytes, uint64_t size,
                              assay_builtin_error* error);

#ifdef __cplusplus
}
#endif

#endif
