/* The C interface of a detector that is to be certified. The detector is a shared library with one
 * symbol, assay_detector(), which returns a table of functions. C99 or C++; no library of Assay is
 * linked. tests/plugins/example.c is an example in C, and README.md in this folder has an example
 * in C++. The program that judges the detector, the host, calls the table like this:
 *
 *   const assay_detector_api* detector = assay_detector();
 *   if (detector->create(triangles, m, positions, n, &handle, &message)) return report(message);
 *   if (detector->evaluate(handle, x_t0, x_t1) == ASSAY_OK &&
 *       detector->result(handle, &result) == ASSAY_OK)
 *     use(result.answer);
 *   detector->destroy(handle);
 *
 * A detector is given a mesh once and then steps of this mesh: over t in [0,1] every vertex moves
 * linearly from x_t0 to x_t1. It answers whether there is a contact, when the first contact is, and
 * which triangles meet. Two triangles are in contact when a vertex, edge or face of one meets a
 * vertex, edge or face of the other and the two share no vertex. Touching counts, and a contact at
 * t = 0 or t = 1 counts. With a separation, "in contact" means "within this distance". The doubles
 * given are exact numbers, in the user's units of length. Times are fractions of the step.
 *
 * MEMORY. The host frees no memory of the detector, and the detector no memory of the host. Arrays
 * that the host passes are valid during the call and must not be written. Arrays and texts that the
 * detector returns belong to the detector, and stay valid until the next call with the same handle.
 *
 * THREADS. A handle is used by one thread at a time; several handles may be used at once by
 * different threads, so a detector must have no mutable global data, or must guard it.
 *
 * ERRORS are return codes. No exception, longjmp or exit() may leave a function of the table: the
 * host counts these as crashes. A call that fails changes nothing, and the handle stays valid.
 *
 * ORDER. create; then any number of (evaluate, result, and commit if the host accepts the step);
 * destroy. A step usually starts where the last committed step ended. A step that starts elsewhere
 * is a new start: then the detector must not rely on anything from earlier steps.
 *
 * LEFT OUT. If the description's contract leaves out a step, for example because it starts in
 * contact, the detector does not get this step, and the next step is a new start.
 *
 * PARTS. A library need not have a detector of whole steps. It can have only an elementary query
 * (vertex-face, edge-edge), only the candidate pairs of a broad phase, or only a limiter, which
 * says how far a step may be taken. It fills in the functions that it has and sets all other
 * functions to NULL. A library has all of evaluate, commit and result, or none of them. If it has
 * these, candidates or limit, it also has create and destroy.
 *
 * VERSIONS. abi_version is the first member of the table in every version. New members are only
 * added at the end, with a new version number. A host of this version also loads tables of older
 * versions. It reads a table of version 1 up to destroy and its description up to margin, and a
 * table of version 2 up to error_text and its description up to reports. It treats all later
 * members as 0. A host refuses a table of a later version than its own. */
#ifndef ASSAY_DETECTOR_H
#define ASSAY_DETECTOR_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define ASSAY_DETECTOR_ABI_VERSION 3u

#if defined(_WIN32)
#define ASSAY_DETECTOR_EXPORT __declspec(dllexport)
#else
#define ASSAY_DETECTOR_EXPORT __attribute__((visibility("default")))
#endif

/* Return codes. */
enum {
  ASSAY_OK = 0,
  ASSAY_REFUSED = 1,       /* the detector does not take this input */
  ASSAY_OUT_OF_MEMORY = 2, /* the step counts as undecided */
  ASSAY_FAILED = 3         /* any other failure */
};

/* `refused: capacity`: the mesh or the step is beyond the capacity of the detector. This is a
 * return code of create, evaluate, result, candidates and limit, and also an answer of a step. If
 * the mesh or the step exceeds a capacity in the description, this refusal is counted and breaks no
 * claim. If it exceeds none, this refusal is judged like any other. Beyond the capacity only this
 * refusal is excused: any other answer has to be right. */
enum { ASSAY_BEYOND_CAPACITY = 4 };

/* The claims of the detector. Only these are judged. t* is the first contact time. */
enum {
  ASSAY_CLAIM_FREE_SOUND = 1u << 0,    /* the answer is never `free` when there is a contact */
  ASSAY_CLAIM_NOT_LATE = 1u << 1,      /* first_lo <= t* */
  ASSAY_CLAIM_FIRST_TIME = 1u << 2,    /* first_lo <= t* <= first_hi */
  ASSAY_CLAIM_FIRST_PAIRS = 1u << 3,   /* each connected part of the contact graph at t* (triangles
                                          as nodes, contacts as edges) has a reported pair */
  ASSAY_CLAIM_ALL_PAIRS = 1u << 4,     /* every pair in contact during the step is reported, and no
                                          reported time of a pair is later than its first contact */
  ASSAY_CLAIM_NO_SPURIOUS = 1u << 5,   /* no collision, pair or contact time is reported before
                                          there is a contact */
  ASSAY_CLAIM_DETERMINISTIC = 1u << 6, /* the same calls give the same results */
  ASSAY_CLAIM_TOTAL = 1u << 7,         /* every valid input within the limits of time and memory is
                                          answered */
  ASSAY_CLAIM_CANDIDATES = 1u << 8,    /* every pair in contact is among the pairs that the table's
                                          `candidates` gives */
  /* Claims of the table's `limit`, in steps that start without a contact. With a separation, a
   * contact means that triangles come within it. */
  ASSAY_CLAIM_COMMIT_FREE = 1u << 9, /* the straight step from x_t0 to the positions that `limit`
                                        allows has no contact */
  ASSAY_CLAIM_PATH_FREE = 1u << 10,  /* the share of the step that `limit` allows is below t* */
  ASSAY_CLAIM_PROGRESS = 1u << 11,   /* this share is at least progress * t*, with t* = 1 if there
                                        is no contact. Judged only if the share progress * t* moves
                                        some vertex by 2^10 units in its last place, and all gaps at
                                        the start are at least 2^6 units in the last place of the
                                        largest coordinate, in the contract's coordinates */
  ASSAY_CLAIM_WHOLE = 1u << 12       /* `limit` allows all of a step without a contact */
};

/* Which pairs of neighbouring triangles the detector tests. A contact of a pair that it does not
 * test is counted, and breaks no claim. */
enum {
  ASSAY_ADJACENCY_ALL = 0,              /* every pair of triangles */
  ASSAY_ADJACENCY_NOT_EDGE_SHARING = 1, /* pairs that share at most one vertex */
  ASSAY_ADJACENCY_NO_SHARED_VERTEX = 2  /* pairs that share nothing */
};

enum {
  ASSAY_COORDINATES_FLOAT64 = 0,
  ASSAY_COORDINATES_FLOAT32 = 1 /* every coordinate is a float32 in a double: it is rounded before
                                   the detector and the oracle get it */
};

/* Which steps the detector takes, by the places at t = 0. All other steps are left out. */
enum {
  ASSAY_START_ANY = 0,  /* every step */
  ASSAY_START_FREE = 1, /* steps that start without a contact */
  /* Steps in which all pairs of features are at least start_distance apart at t = 0: each vertex
   * from each face, and each edge from each edge, unless they share a vertex. */
  ASSAY_START_APART = 2
};

/* Which pairs of features the detector tests. Contacts that it cannot find in this way are counted,
 * and break no claim. If it tests only one kind, these are the contacts of the other kind, and the
 * contacts of edges that pierce a face already when the step starts. */
enum { ASSAY_FEATURES_BOTH = 0, ASSAY_FEATURES_VERTEX_FACE = 1, ASSAY_FEATURES_EDGE_EDGE = 2 };

enum {
  ASSAY_REPORTS_PAIRS = 0,
  ASSAY_REPORTS_NO_PAIRS = 1 /* only the answer and the time are reported; the claims on pairs
                                (first-pairs, all-pairs) are not judged */
};

/* Says whether pairs of triangles or pairs of features count. A pair of features is a vertex and a
 * face, or two edges, that share no vertex. With features, two triangles are in contact only if a
 * feature pair of the two counts and is in contact. An edge that pierces a face at t = 0 counts if
 * some feature pair of the two triangles counts. */
enum { ASSAY_COUNTS_TRIANGLES = 0, ASSAY_COUNTS_FEATURES = 1 };

/* How the end of a step is given. With displacements, coordinates are float32, and the parameter
 * x_t1 of every function has d = x_t1 - x_t0 instead: a vertex moves from x to x + d, the exact sum
 * of two float32 numbers. A limiter's share 1 then means the float32 nearest to this sum. */
enum { ASSAY_MOTION_ENDS = 0, ASSAY_MOTION_DISPLACEMENT = 1 };

/* Where the caller stops if a limiter gives a share of the step: at positions that the limiter also
 * gives, or at positions that the code of the caller computes from the share. The host computes the
 * latter in the same way, in the contract's coordinates, with one rounding for each operation. */
enum {
  ASSAY_LIMIT_POSITIONS = 0,  /* the limiter gives the positions */
  ASSAY_LIMIT_START_PLUS = 1, /* x_t0 + share * (x_t1 - x_t0) */
  ASSAY_LIMIT_BLEND = 2       /* (1 - share) * x_t0 + share * x_t1 */
};

#define ASSAY_WIDEST_TIME_TOLERANCE 1e-3

/* The detector's name, its claims, and its contract. The contract is all members from adjacency on.
 * A contract whose members are all 0 leaves nothing out. A description that sets only the members
 * up to margin has the contract of version 1. */
typedef struct assay_description {
  const char* name;    /* one line, not empty */
  const char* version; /* one line */
  uint32_t claims;     /* ASSAY_CLAIM_..., or-ed */
  int32_t adjacency;   /* ASSAY_ADJACENCY_... */
  int32_t coordinates; /* ASSAY_COORDINATES_... */
  double margin;       /* user's units; finite, >= 0. The detector may also report triangles that
                          come within separation + margin. If margin is above 0, first-time is not
                          judged, and no-spurious only with ASSAY_ADJACENCY_NO_SHARED_VERTEX */

  /* Since version 2. */
  int32_t start;         /* ASSAY_START_... */
  double start_distance; /* user's units; above 0 with ASSAY_START_APART, else 0 */
  /* The sizes that the detector takes, in user's units; other meshes are left out. No coordinate is
   * larger than `largest`, because rounding depends on coordinates. The length of an edge, and the
   * extent of the mesh, is 0 or at least least_nonzero, because thresholds depend on lengths; a
   * length is the greatest difference along an axis. A coordinate may be arbitrarily small. Both 0:
   * every finite number is taken. Otherwise 0 <= least_nonzero <= largest, and largest > 0. */
  double least_nonzero;
  double largest;
  int32_t features;      /* ASSAY_FEATURES_... */
  double time_tolerance; /* a time counts as late, early or wrong when it is off by more than this
                            share of the step; 0 <= time_tolerance <= 1e-3 */
  int32_t reports;       /* ASSAY_REPORTS_... */

  /* Since version 3. */
  double separation; /* user's units; finite, >= 0. Above 0, the detector finds triangles that come
                        within this distance (or touch): read `within separation` wherever a claim
                        says `in contact`. This needs ASSAY_ADJACENCY_NO_SHARED_VERTEX, because
                        neighbours are always near. The elementary query then finds features that
                        come within this distance */
  /* The pairs left out besides neighbours. The mesh at rest has the positions given to create. */
  int32_t counts;       /* ASSAY_COUNTS_...: the pairs that rings and rest_distance leave out */
  int32_t rings;        /* leaves out pairs joined by a path of fewer edges of the mesh */
  double rest_distance; /* leaves out pairs nearer to each other at rest than this, user's units */
  int32_t limit_gives;  /* ASSAY_LIMIT_...: where the caller stops if it gets only a share */
  double progress;      /* for ASSAY_CLAIM_PROGRESS: above 0, at most 1; without this claim 0 */
  int32_t motion;       /* ASSAY_MOTION_... */
  /* The capacity of the detector; 0: no limit. Beyond it, ASSAY_BEYOND_CAPACITY is allowed. */
  uint64_t capacity_triangles;  /* the number of triangles of the mesh */
  uint64_t capacity_contacts;   /* the number of pairs of triangles in contact during the step,
                                   without the pairs that the contract leaves out */
  uint64_t capacity_candidates; /* the number of pairs of features (a vertex and a face, or two
                                   edges) that share no vertex and whose boxes around their whole
                                   way meet, or come within the separation */
} assay_description;

/* The members of the contract, for code that treats all of them alike: X(kind, name, the version
 * that added the member). An integer is an int32_t, a real is a double, a count is a uint64_t. */
/* clang-format off */
#define ASSAY_CONTRACT_MEMBERS(X) \
  X(integer, adjacency, 1) X(integer, coordinates, 1) X(real, margin, 1) X(integer, start, 2) \
  X(real, start_distance, 2) X(real, least_nonzero, 2) X(real, largest, 2) X(integer, features, 2) \
  X(real, time_tolerance, 2) X(integer, reports, 2) X(real, separation, 3) X(integer, counts, 3) \
  X(integer, rings, 3) X(real, rest_distance, 3) X(integer, limit_gives, 3) X(real, progress, 3) \
  X(integer, motion, 3) X(count, capacity_triangles, 3) X(count, capacity_contacts, 3) \
  X(count, capacity_candidates, 3)
/* clang-format on */

/* The data that the detector has for one mesh. */
typedef struct assay_handle assay_handle;

enum { ASSAY_FREE = 0, ASSAY_COLLISION = 1, ASSAY_UNDECIDED = 2, ASSAY_ERROR = 3 };

/* The result of a step. The host sets all members to 0 before the call. */
typedef struct assay_result {
  int32_t answer; /* ASSAY_FREE, ASSAY_COLLISION, ASSAY_UNDECIDED, ASSAY_ERROR,
                     ASSAY_BEYOND_CAPACITY */
  /* With ASSAY_COLLISION: the interval of the first contact time, 0 <= first_lo <= first_hi <= 1.
   * [0, 1] states nothing about the time. */
  double first_lo;
  double first_hi;
  uint64_t pair_count;      /* pairs of triangles in contact, in any order, each once or more */
  const int32_t* pairs;     /* pair_count x 2 triangle indices; may be NULL if pair_count is 0 */
  const double* pair_times; /* pair_count x 2, lo and hi of each pair's first contact. NULL if the
                               times are not known: then pairs are judged without times */
  const char* message;      /* with ASSAY_ERROR: one line, or NULL */
} assay_result;

/* Which pairs do not count: they must not be reported, and make no step a collision. All other
 * pairs count. "The two" are two triangles or two features, depending on `level`. */
typedef struct assay_counted_pairs {
  int32_t level; /* ASSAY_COUNTS_... */
  /* For each vertex the number of its body, from 0 on; NULL: all vertices belong to body 0. The
   * three vertices of a triangle belong to one body. */
  const int32_t* body;
  uint64_t apart_count;
  const int32_t* apart; /* apart_count x 2 bodies a, b: no pair of a and b counts; a may equal b */
  int32_t rings;        /* the two do not count if a path of fewer edges joins them; 0: not used */
  double rest_distance; /* the two do not count if they are nearer at rest; 0: not used */
  const double* rest;   /* vertex_count x 3 places at rest; NULL if rest_distance is 0 */
  /* Lists of pairs that do not count: the first for triangles, the other two for features. */
  uint64_t triangle_pair_count;
  const int32_t* triangle_pairs; /* triangle_pair_count x 2 */
  uint64_t vertex_face_count;
  const int32_t* vertex_faces; /* vertex_face_count x 2: vertex, triangle */
  uint64_t edge_pair_count;
  const int32_t* edge_pairs; /* edge_pair_count x 4: two vertices for each edge */
} assay_counted_pairs;

enum { ASSAY_QUERY_VERTEX_FACE = 0, ASSAY_QUERY_EDGE_EDGE = 1 };

/* The result of one elementary query. The host sets all members to 0 before the call. */
typedef struct assay_query_result {
  int32_t answer;  /* ASSAY_FREE, ASSAY_COLLISION, ASSAY_UNDECIDED, ASSAY_ERROR */
  double first_lo; /* first_lo and first_hi are as in assay_result */
  double first_hi;
} assay_query_result;

/* The pairs of triangles that a broad phase finds: pairs that may be in contact during the step.
 * The host sets all members to 0 before the call. */
typedef struct assay_candidates {
  uint64_t pair_count;  /* in any order, each once or more */
  const int32_t* pairs; /* pair_count x 2 triangle indices; may be NULL if pair_count is 0 */
} assay_candidates;

/* How far a caller may go in a step. The host sets share to -1 and positions to NULL before the
 * call. Share 1 means x_t1 itself. Share 0, or positions equal to x_t0, means that the mesh stays.
 * A limiter that limits each vertex by itself gives only positions. */
typedef struct assay_limit {
  double share;            /* the share of the step, 0 to 1; -1: not given */
  const double* positions; /* vertex_count x 3, finite: where the caller stops. If NULL, the
                              description's limit_gives says where the caller stops */
} assay_limit;

typedef struct assay_detector_api {
  uint32_t abi_version; /* ASSAY_DETECTOR_ABI_VERSION */

  /* Describes the detector: the same at every call, valid while the library is loaded. */
  const assay_description* (*describe)(void);

  /* Makes a handle for a mesh. triangles: triangle_count x 3 vertex indices, counter-clockwise seen
   * from outside. positions: vertex_count x 3 doubles of the first frame. The detector must copy
   * what it needs later of both arrays. The mesh may be open, have several parts, or be in contact
   * with itself already. With a return code other than ASSAY_OK the function does not set *handle,
   * and may set *message to a line of static text. */
  int32_t (*create)(const int32_t* triangles, uint64_t triangle_count, const double* positions,
                    uint64_t vertex_count, assay_handle** handle, const char** message);

  /* Answers the step from x_t0 to x_t1, each vertex_count x 3 finite doubles. It does not change
   * the state that the detector carries from step to step: commit does. */
  int32_t (*evaluate)(assay_handle* handle, const double* x_t0, const double* x_t1);

  /* Accepts the step evaluated last: the state advances to the end of that step. */
  int32_t (*commit)(assay_handle* handle);

  /* Fills in the result of the step evaluated last. */
  int32_t (*result)(assay_handle* handle, assay_result* result);

  /* Frees the handle. */
  void (*destroy)(assay_handle* handle);

  /* Since version 2. Each of these functions may be NULL. */

  /* Sets how many threads the detector may use, 1 or more. Called once, before every function
   * except describe. With ASSAY_CLAIM_DETERMINISTIC, results must not depend on this number. */
  void (*use_threads)(uint32_t count);

  /* Answers whether two features meet during the step, and when first. A library can have only this
   * elementary query (PARTS above); `check`, `self-test` and campaigns of queries judge it. kind:
   * ASSAY_QUERY_... x_t0 and x_t1 are 4 x 3 doubles each: the vertex and the three corners of the
   * face, or the two ends of one edge and the two ends of the other. It needs no handle. */
  int32_t (*query)(int32_t kind, const double* x_t0, const double* x_t1,
                   assay_query_result* result);

  /* Gives the pairs that may be in contact during the step. This is a broad phase, judged by
   * ASSAY_CLAIM_CANDIDATES. It does not depend on earlier steps. */
  int32_t (*candidates)(assay_handle* handle, const double* x_t0, const double* x_t1,
                        assay_candidates* candidates);

  /* Returns why the last failed call in this thread, of whichever function, has failed: one line,
   * valid until the next call, or NULL. The host calls it at once after a return code other than
   * ASSAY_OK, after an ASSAY_ERROR without a message, and after a describe() that returns NULL. */
  const char* (*error_text)(void);

  /* Since version 3. Each of these functions may be NULL. */

  /* Gets the pairs that count. The host calls it once, before the first step, unless every pair
   * counts. The detector must copy what it needs later. Without this function every pair counts. */
  int32_t (*count)(assay_handle* handle, const assay_counted_pairs* counted);

  /* Says how far the step may be taken. It does not depend on earlier steps (see PARTS above). */
  int32_t (*limit)(assay_handle* handle, const double* x_t0, const double* x_t1,
                   assay_limit* limit);
} assay_detector_api;

/* The one symbol that a plug-in exports. The table is valid as long as the library is loaded. */
ASSAY_DETECTOR_EXPORT const assay_detector_api* assay_detector(void);

#ifdef __cplusplus
}
#endif

#endif
