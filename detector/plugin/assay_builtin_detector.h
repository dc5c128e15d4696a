/* The built-in detector in C. It is for programs in C, and for programs that use any detector
 * through the interface of assay_detector.h. C99 or C++; link assay::detector. For example:
 *
 *   assay_builtin_options options = ASSAY_BUILTIN_DEFAULTS;
 *   assay_builtin_error error;
 *   assay_handle* handle = NULL;
 *   if (assay_builtin_create(triangles, m, positions, n, &options, &handle, &error) != ASSAY_OK)
 *     return report(error.message);
 *
 * The table that assay_builtin_detector() returns and the functions of this header work on the same
 * handles, under the rules of assay_detector.h on memory, threads and order. The functions of this
 * header do what the table does, with options and named errors in addition.
 *
 * ERRORS. A function that takes an `error` returns ASSAY_OK, ASSAY_REFUSED or ASSAY_OUT_OF_MEMORY.
 * A call that does not return ASSAY_OK has changed nothing, with one exception: after a failed
 * evaluate there is nothing to commit. `error` may be NULL. If it is not NULL, every call
 * sets it; ASSAY_OK goes with ASSAY_BUILTIN_NO_ERROR and an empty message. Handles and arrays must
 * not be NULL unless the comment of a function says that they may be NULL.
 *
 * THE PROCESSOR. Answers do not depend on the state that the caller has set: flushing of denormals,
 * rounding mode, traps. Each call restores this state when it returns, and calls stop() in it. */
#ifndef ASSAY_BUILTIN_DETECTOR_H
#define ASSAY_BUILTIN_DETECTOR_H

#include "detector/plugin/assay_detector.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Returns the built-in detector as a table of assay_detector.h, with the default options. The table
 * is never NULL and always valid. */
const assay_detector_api* assay_builtin_detector(void);

/* The errors. A number never changes its meaning, and new errors get new numbers. 11 and 65 were
 * errors that no longer exist. */
enum {
  ASSAY_BUILTIN_NO_ERROR = 0,
  ASSAY_BUILTIN_NO_TRIANGLES = 1,          /* an empty mesh */
  ASSAY_BUILTIN_INDEX_OUT_OF_RANGE = 2,    /* a triangle names a vertex that does not exist */
  ASSAY_BUILTIN_REPEATED_INDEX = 3,        /* a triangle names one vertex twice */
  ASSAY_BUILTIN_SAME_VERTICES_TWICE = 4,   /* two triangles have the same three vertices */
  ASSAY_BUILTIN_WRONG_FRAME_SIZE = 5,      /* (cannot occur in C: arrays have no size) */
  ASSAY_BUILTIN_NON_FINITE_COORDINATE = 6, /* NaN or infinity, also in a view primitive */
  ASSAY_BUILTIN_WRONG_PRIMITIVE_COUNT = 7, /* not 0, 1, or the number of components */
  ASSAY_BUILTIN_NOTHING_TO_COMMIT = 8,     /* no step with an answer was evaluated */
  ASSAY_BUILTIN_FOREIGN_STATE = 9,         /* (cannot occur in C: no function takes a state) */
  ASSAY_BUILTIN_DAMAGED_STATE = 10,        /* (cannot occur in C: no function takes a state) */
  ASSAY_BUILTIN_MESH_TOO_LARGE = 12,       /* more triangles or vertices than indices can number */
  ASSAY_BUILTIN_STOPPED = 13,              /* (cannot occur in C: create has no stop function) */
  ASSAY_BUILTIN_TRIANGLE_OF_TWO_BODIES = 14, /* (cannot occur in C: create has no bodies) */
  ASSAY_BUILTIN_WRONG_RELATION = 15,         /* (cannot occur in C: create has no counted pairs) */
  ASSAY_BUILTIN_WRONG_SEPARATION = 16,       /* not a distance, or other options exclude it */
  ASSAY_BUILTIN_PROVES_NOTHING = 17,         /* a limit with arithmetic double or float */
  ASSAY_BUILTIN_WRONG_BOUND = 18,            /* until is not from 0 to 1 */
  ASSAY_BUILTIN_WRONG_OPTIONS = 64,          /* a wrong value of an option, or of struct_size */
  ASSAY_BUILTIN_TOO_MANY = 66,               /* more than 2^31 - 1 triangles or vertices */
  ASSAY_BUILTIN_NO_MEMORY = 67
};

/* Returns the name of an error, such as "index_out_of_range", or "unknown_error" for any other
 * number. Static text. */
const char* assay_builtin_error_name(int32_t code);

/* An error. The caller owns the struct. */
typedef struct assay_builtin_error {
  int32_t code;      /* ASSAY_BUILTIN_... */
  char message[252]; /* one line for a user, cut if it does not fit; ends with 0 */
} assay_builtin_error;

/* The values of the options. The default culling is ASSAY_CULLING_AUTO; every other option has the
 * value 0 by default. detector/README.md says what the options mean for the result. */
enum {
  ASSAY_CULLING_VIEW_AUTO = 0,   /* VIEW_POINT or VIEW_LINE for each component; BVH in steps where
                                    views do not pay */
  ASSAY_CULLING_VIEW_POINT = 1,  /* each component is seen from a point */
  ASSAY_CULLING_VIEW_LINE = 2,   /* each component is seen from a segment */
  ASSAY_CULLING_NORMAL_CONE = 3, /* BVH without pairs in a patch that has a normal cone and a
                                    simple contour */
  ASSAY_CULLING_BVH = 4,         /* pairs whose boxes meet, found by a tree of boxes */
  ASSAY_CULLING_NONE = 5,        /* every pair is tested, without boxes */
  ASSAY_CULLING_AUTO = 6         /* VIEW_AUTO and NORMAL_CONE in one descent, each used only if it
                                    is expected to pay */
};
/* The triangles taken for clean at a new start. detector/LAWS.md defines clean and dirty. */
enum {
  ASSAY_START_VERIFIED = 0, /* those that the detector proves clean at each new start */
  ASSAY_START_CLEAN = 1,    /* all: the caller vouches that none is in contact, and that all of a
                               component have the same layer */
  ASSAY_START_UNKNOWN = 2   /* none */
};
enum {
  ASSAY_PAIRS_ALL = 0,  /* every pair that is in contact at some time of the step */
  ASSAY_PAIRS_FIRST = 1 /* the first contact time, and some pairs that meet by its upper end */
};
enum {
  ASSAY_ARITHMETIC_EXACT = 0,   /* never wrong */
  ASSAY_ARITHMETIC_BOUNDED = 1, /* never misses a contact; gives some false alarms */
  ASSAY_ARITHMETIC_DOUBLE = 2,  /* promises nothing; made to be measured */
  ASSAY_ARITHMETIC_FLOAT = 3    /* promises nothing; made to be measured */
};
typedef struct assay_builtin_options {
  uint32_t struct_size; /* sizeof(assay_builtin_options): later versions may add members */
  int32_t culling;      /* ASSAY_CULLING_... */
  int32_t start;        /* ASSAY_START_... */
  int32_t pairs;        /* ASSAY_PAIRS_... */
  int32_t arithmetic;   /* ASSAY_ARITHMETIC_... */
  uint32_t threads;     /* the most threads that are used; 0: one for each processor of the machine.
                           The results do not depend on it */
  double separation;    /* 0: finds contacts. Above 0: finds pairs of triangles without a common
                           vertex that come within this distance; then culling must be BVH or NONE,
                           and arithmetic EXACT. 0 if struct_size is too small for this member */
} assay_builtin_options;

#define ASSAY_BUILTIN_DEFAULTS \
  { sizeof(assay_builtin_options), ASSAY_CULLING_AUTO, 0, 0, 0, 1, 0 }

/* Does what the table's create does, with options (NULL: the defaults). Sets *handle only if it
 * returns ASSAY_OK. */
int32_t assay_builtin_create(const int32_t* triangles, uint64_t triangle_count,
                             const double* positions, uint64_t vertex_count,
                             const assay_builtin_options* options, assay_handle** handle,
                             assay_builtin_error* error);

/* A place, anywhere, from which the mesh is viewed; it replaces the detector's own choice. It is a
 * segment from q0 to q1, each given at t = 0 and at t = 1, or a point if q0 and q1 are equal. */
typedef struct assay_view_primitive {
  double q0_t0[3], q0_t1[3], q1_t0[3], q1_t1[3];
} assay_view_primitive;

/* Does what the table's evaluate does; a call of the table's `result` then gets the answer.
 * primitive_count is 0 (the detector chooses the places), 1 (one primitive for all components), or
 * the number of components (the primitives are in the order of the components' lowest vertices).
 * stop is called now and then with stop_data. If it does not return 0, the work stops with the
 * answer ASSAY_UNDECIDED. stop may be NULL. */
int32_t assay_builtin_evaluate(assay_handle* handle, const double* x_t0, const double* x_t1,
                               const assay_view_primitive* primitives, uint64_t primitive_count,
                               int32_t (*stop)(void* stop_data), void* stop_data,
                               assay_builtin_error* error);

/* Answers whether there is a contact by the time `until`, from 0 to 1, and which contact is first.
 * The pairs are those of ASSAY_PAIRS_FIRST, whatever the options say. ASSAY_FREE means that there
 * is no contact in [0, until]; a contact at `until` itself counts. Later contacts are not looked
 * for, so a caller that knows a contact passes its time as `until`. A call of the table's `result`
 * then gets the answer. The step can be committed only if until is 1. stop may be NULL. */
int32_t assay_builtin_first_contact(assay_handle* handle, const double* x_t0, const double* x_t1,
                                    double until, int32_t (*stop)(void* stop_data), void* stop_data,
                                    assay_builtin_error* error);

/* Does what the table's limit does: the way to the positions in *limit is free, rounding included.
 * The share is 1 for a free step, else 0.95 of the first contact time, or less if the way to that
 * place, once rounded, has a contact (see detector/detector.h). Share 0 means that the mesh stays:
 * there is a contact at the start or on the way to every place that was tried, or stop() ended the
 * work. A commit goes to these positions; after share 0 it is refused. stop may be NULL. */
int32_t assay_builtin_limit(assay_handle* handle, const double* x_t0, const double* x_t1,
                            assay_limit* limit, int32_t (*stop)(void* stop_data), void* stop_data,
                            assay_builtin_error* error);

/* Returns 1 if the share of the last limit is below 0.93 of the first contact time, because the way
 * to every farther place that was tried has, once rounded, a contact; otherwise 0. */
int32_t assay_builtin_limit_is_short(const assay_handle* handle);

/* Where a pair of the last result meets, at the lower end of its time (contact_place.h). */
typedef struct assay_contact_place {
  double point[3];
  double barycentric[2][3]; /* for each triangle, corner weights; the weighted sum is the point */
  double error;             /* no coordinate of this sum differs more from the point */
  double normal[3];         /* the unit normal of the face or of both edges; 0 if there is none */
  double normal_error;      /* no coordinate of `normal` is off by more than this; 0: no normal */
} assay_contact_place;

/* Sets *place to the place of a pair of the last result. x_t0 and x_t1 must be the positions that
 * were evaluated. Returns 1, or 0 if the result has no such pair (pairs are numbered from 0). */
int32_t assay_builtin_place(const assay_handle* handle, const double* x_t0, const double* x_t1,
                            uint64_t pair, assay_contact_place* place);

/* Does what the table's commit does. After a limit, the step ends at the limit's positions. */
int32_t assay_builtin_commit(assay_handle* handle, assay_builtin_error* error);

/* The view sets of the step evaluated last. If that step used no views, all sizes are 0 and doubts
 * is NULL. If it used views, the first four sizes add up to the number of triangles. */
typedef struct assay_builtin_sets {
  uint64_t view_positive, view_negative, view_zero; /* sizes of V+, V-, V0, each without Vv */
  uint64_t against_all;  /* size of Vv: the triangles that are violated, dirty or both */
  uint64_t violated;     /* how many triangles a ghost touches during the step */
  uint64_t dirty;        /* how many triangles are dirty at the start of the step */
  const uint8_t* doubts; /* by triangle, bit 0: violated, bit 1: dirty. The array belongs to the
                            detector */
} assay_builtin_sets;
void assay_builtin_get_sets(const assay_handle* handle, assay_builtin_sets* sets);

/* Forgets the committed steps: the next step is a new start. The table's result stays the same. */
void assay_builtin_reset(assay_handle* handle);

#ifdef __cplusplus
}
#endif

#endif
