/* Records what a simulator does, in a log that `assay check` reads: its mesh, each of its steps,
 * and what its own collision detector answers. C99 or C++11; it needs only this header and
 * assay_detector.h beside it, and no library. A simulator uses it like this:
 *
 *   assay_recorder recorder;
 *   assay_record_settings settings = {"steps.log", 1, 0};
 *   assay_record_array start = {positions, 0};
 *   assay_record_begin(&recorder, &settings, &description, triangles, m, start, n, NULL);
 *   while (simulate(&step)) assay_record_step(&recorder, &step);
 *   if (assay_record_end(&recorder) != ASSAY_OK) report(assay_record_error(&recorder));
 *
 * corpus/README.md (Step logs) describes the form of the log. Positions are recorded unchanged,
 * even if they are not finite, because a log has to show what the simulator did.
 *
 * MEMORY. The caller owns the recorder, about 17 KB, and all arrays. No array is needed after the
 * call. The recorder allocates a copy of the path and, if steps are left out, room for the
 * positions of one frame. assay_record_end frees both.
 *
 * THREADS. A recorder is used by one thread at a time, and is independent of other recorders.
 *
 * ERRORS. Each function that returns int32_t returns ASSAY_OK or an error number;
 * assay_record_error returns one line about the error. A call that is refused writes nothing and
 * does not change the recorder. A write that fails ends the log, perhaps in the middle of a record.
 * All later records are refused with the same error, because a log is read only up to its first
 * damage. To go on, call assay_record_end and begin another log in another file.
 *
 * COST. Arrays are written directly from the caller's memory, without a buffer, so a process that
 * is killed loses at most the record that it was writing. A step takes at most about twice the time
 * that fwrite takes for its arrays. */
#ifndef ASSAY_RECORD_H
#define ASSAY_RECORD_H

#include <errno.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "assay_detector.h"

/* The error numbers besides ASSAY_OUT_OF_MEMORY. A number never changes its meaning. */
enum {
  ASSAY_RECORD_WRONG_ARGUMENT = 16, /* refused: an argument is missing or has a wrong value */
  ASSAY_RECORD_NO_START = 17,       /* refused: x0 is absent, and the end of the last step is not
                                       known */
  ASSAY_RECORD_NOT_BEGUN = 18,      /* refused: begin did not succeed, or end was called */
  ASSAY_RECORD_FILE_EXISTS = 19,    /* refused: the file exists and would be overwritten */
  ASSAY_RECORD_NOT_OPENED = 20,     /* the file could not be opened */
  ASSAY_RECORD_NOT_WRITTEN = 21,    /* not all of this record or of an earlier one was written */
  ASSAY_RECORD_NO_ANSWER = 23       /* refused: the result or limit is impossible, such as a time
                                       outside of [0, 1], and so could not be judged */
};

/* The file of a log, and which steps are recorded. */
typedef struct assay_record_settings {
  const char* path;
  uint64_t every;    /* one step in `every` is recorded, beginning with the first; 0 is like 1 */
  int32_t overwrite; /* a file that exists and is not empty is refused (0) or emptied (1) */
} assay_record_settings;

/* An array of vertex_count x 3 numbers, double or float. If data is NULL, the array is absent. */
typedef struct assay_record_array {
  const void* data;
  int32_t is_float32; /* 0: double */
} assay_record_array;

/* A step, in the user's units. Clear the struct (all 0); then fill in what the simulator has. */
typedef struct assay_record_step_data {
  assay_record_array x0;        /* where the step starts. If absent, it starts at the last step's
                                   `committed` or, if that is absent too, at the last step's x1 */
  assay_record_array x1, dx;    /* exactly one of: the end of the step, the displacement x1 - x0 */
  assay_record_array committed; /* where the simulator really went, or absent */
  const assay_result* result;   /* the answer of the simulator's detector, or NULL */
  const assay_limit* limit;     /* the answer of the simulator's limiter, or NULL */
} assay_record_step_data;

/* A log that is being written. Only the functions of this header use its members. */
typedef struct assay_recorder {
  uint32_t crc_tables[16][256];
  char error[256];
  /* The record that is being written. */
  unsigned char staged[256]; /* small pieces that are not in the file yet */
  size_t staged_size;
  uint64_t body_size, keys;
  int32_t is_counted; /* 1 in the first pass over the body, which computes body_size and keys */
  int32_t has_failed; /* 1 if a write has failed, with errno `reason` */
  int32_t reason;
  uint32_t crc;
  /* The log. */
  int32_t is_begun;
  int32_t triangle_count; /* at this place the struct needs no padding */
  uint64_t every, vertex_count;
  char* path;
  FILE* file;
  uint64_t next_step, next_record;
  /* Where the last step ended. */
  int32_t end_is_known, end_is_float32;
  void* end;
} assay_recorder;

/* Opens the file, and records the mesh and the claims of the simulator's detector. If the recorder
 * is recording, call assay_record_end first; if not, it need not be initialized.
 *
 * description: as for a detector that is certified. triangles: triangle_count x 3 vertex indices.
 * positions: those from which the detector was made. counted: which pairs count; NULL: every pair
 * counts. */
static inline int32_t assay_record_begin(assay_recorder* recorder,
                                         const assay_record_settings* settings,
                                         const assay_description* description,
                                         const int32_t* triangles, uint64_t triangle_count,
                                         assay_record_array positions, uint64_t vertex_count,
                                         const assay_counted_pairs* counted);

/* Records the next step, or only counts it if `every` leaves it out. If x0 is absent and the step
 * before is not in the file, the recorder writes x0 from its own copy. A step without x0 is refused
 * if it is the first step, or if the step before has a dx and no committed positions. */
static inline int32_t assay_record_step(assay_recorder* recorder,
                                        const assay_record_step_data* step);

/* Records a line of text before the next step. Bytes that are not UTF-8 become question marks. */
static inline int32_t assay_record_note(assay_recorder* recorder, const char* text);

/* Records the number of steps, closes the file and frees the memory of the recorder, also if a
 * write fails. Call it once for each successful call of assay_record_begin. */
static inline int32_t assay_record_end(assay_recorder* recorder);

/* Returns one line about the last call that failed, or "". It is valid until the next call. */
static inline const char* assay_record_error(const assay_recorder* recorder);

/* All names below end with an underscore and are internal to this header. */

static inline int32_t assay_record_fail_(assay_recorder* r, int32_t code, const char* what,
                                         const char* name, int32_t reason) {
  (void)snprintf(r->error, sizeof r->error, "%.60s%s%.120s%s%.60s", what, *name ? " " : "", name,
                 reason ? ": " : "", reason ? strerror(reason) : "");
  return code;
}

static inline void assay_record_make_tables_(assay_recorder* r) {
  uint32_t byte, k;
  for (byte = 0; byte < 256; ++byte) {
    uint32_t c = byte;
    for (k = 0; k < 8; ++k) c = (c >> 1) ^ (0xEDB88320u & (0u - (c & 1u)));
    r->crc_tables[0][byte] = c;
  }
  for (k = 1; k < 16; ++k)
    for (byte = 0; byte < 256; ++byte) {
      const uint32_t c = r->crc_tables[k - 1][byte];
      r->crc_tables[k][byte] = (c >> 8) ^ r->crc_tables[0][c & 255u];
    }
}

/* Returns four bytes as one number. The first byte is the lowest one on every machine. */
static inline uint32_t assay_record_four_(const unsigned char* p) {
  return (uint32_t)p[0] | (uint32_t)p[1] << 8 | (uint32_t)p[2] << 16 | (uint32_t)p[3] << 24;
}

static inline uint32_t assay_record_four_at_(uint32_t (*tables)[256], uint32_t x) {
  return tables[3][x & 255u] ^ tables[2][x >> 8 & 255u] ^ tables[1][x >> 16 & 255u] ^
         tables[0][x >> 24];
}

/* Adds bytes to the check sum r->crc, 16 bytes at a time. */
static inline void assay_record_sum_few_(assay_recorder* r, const unsigned char* p, size_t n) {
  uint32_t(*const t)[256] = r->crc_tables;
  uint32_t c = r->crc;
  for (; n >= 16; n -= 16, p += 16) {
    c = assay_record_four_at_(t + 12, c ^ assay_record_four_(p)) ^
        assay_record_four_at_(t + 8, assay_record_four_(p + 4)) ^
        assay_record_four_at_(t + 4, assay_record_four_(p + 8)) ^
        assay_record_four_at_(t, assay_record_four_(p + 12));
  }
  for (; n > 0; --n, ++p) c = (c >> 8) ^ t[0][(c ^ *p) & 255u];
  r->crc = c;
}

/* The sum is the remainder when the bytes, read as a polynomial, are divided by a polynomial of
 * degree 32. The remainder after division by any multiple of that polynomial has the same sum; one
 * such multiple has the powers 300, 155, 117, 89 and 0 of x^64. Division by this multiple takes
 * four additions for each word of 64 bits, in any byte order, and leaves 300 words. This is several
 * times as fast as tables. */
enum { ASSAY_RECORD_LEFT_ = 300, ASSAY_RECORD_BLOCK_ = 1024 }; /* numbers of words */

/* Appends `words` words of the quotient. REQUIRES the last 300 words at the start of `quotient`. */
static inline void assay_record_divide_(uint64_t* quotient, const unsigned char* p, size_t words) {
  size_t i;
  for (i = 0; i < words; ++i) {
    uint64_t word;
    memcpy(&word, p + 8 * i, 8);
    quotient[i + 300] =
        word ^ quotient[i] ^ quotient[i + 89] ^ quotient[i + 117] ^ quotient[i + 155];
  }
}

/* Adds many bytes to the sum: more than 300 words. */
static inline void assay_record_sum_many_(assay_recorder* r, const unsigned char* p, size_t n) {
  const size_t left = ASSAY_RECORD_LEFT_, block = ASSAY_RECORD_BLOCK_;
  uint64_t quotient[ASSAY_RECORD_LEFT_ + ASSAY_RECORD_BLOCK_], word;
  size_t words = n / 8 - left, part, i;
  /* The sum so far is added to the first four bytes. The words before the first word are 0. */
  unsigned char first[8];
  memcpy(first, p, 8);
  for (i = 0; i < 4; ++i) first[i] = (unsigned char)(first[i] ^ (r->crc >> 8 * i & 255u));
  memset(quotient, 0, 8 * left);
  memcpy(quotient + left - 1, first, 8);
  for (i = 1; i < words; i += part) {
    part = words - i < block ? words - i : block;
    if (part == block) /* a loop of a known length is compiled better */
      assay_record_divide_(quotient, p + 8 * i, ASSAY_RECORD_BLOCK_);
    else
      assay_record_divide_(quotient, p + 8 * i, part);
    memmove(quotient, quotient + part, 8 * left);
  }
  /* Computes the remainder. The words after the last word of the quotient are 0. */
  memset(quotient + left, 0, 8 * left);
  p += 8 * words;
  n -= 8 * words;
  for (i = 0; i < left; ++i) {
    memcpy(&word, p + 8 * i, 8);
    quotient[i] ^= word ^ quotient[i + 89] ^ quotient[i + 117] ^ quotient[i + 155];
  }
  r->crc = 0;
  assay_record_sum_few_(r, (const unsigned char*)quotient, 8 * left);
  assay_record_sum_few_(r, p + 8 * left, n - 8 * left);
}

/* Adds bytes to the CRC-32 of zlib, without its first and last step. */
static inline void assay_record_sum_(assay_recorder* r, const unsigned char* p, size_t n) {
  if (n < (size_t)16 * ASSAY_RECORD_LEFT_)
    assay_record_sum_few_(r, p, n);
  else
    assay_record_sum_many_(r, p, n);
}

static inline void assay_record_to_file_(assay_recorder* r, const void* data, size_t n) {
  if (r->has_failed || n == 0) return;
  errno = 0;
  if (fwrite(data, 1, n, r->file) == n) return;
  r->has_failed = 1;
  r->reason = errno;
}

static inline void assay_record_flush_(assay_recorder* r) {
  assay_record_to_file_(r, r->staged, r->staged_size);
  r->staged_size = 0;
}

/* Writes bytes without adding them to the sum: these are outside of a body, or summed already. */
static inline void assay_record_raw_(assay_recorder* r, const void* data, size_t n) {
  if (n > sizeof r->staged - r->staged_size) assay_record_flush_(r);
  if (n > sizeof r->staged) {
    assay_record_to_file_(r, data, n);
  } else {
    memcpy(r->staged + r->staged_size, data, n);
    r->staged_size += n;
  }
}

/* Writes bytes of a body. An array is one piece, because few large pieces are written fastest. */
static inline void assay_record_put_(assay_recorder* r, const void* data, uint64_t size) {
  if (r->is_counted) {
    r->body_size += size;
    return;
  }
  assay_record_sum_(r, (const unsigned char*)data, (size_t)size);
  assay_record_raw_(r, data, (size_t)size);
}

static inline void assay_record_big_endian_(unsigned char* out, uint64_t value, int bytes) {
  for (; bytes > 0; --bytes, value >>= 8) out[bytes - 1] = (unsigned char)(value & 255u);
}

/* Makes the shortest head of a CBOR item of type `major` (0 to 7). Returns its number of bytes. */
static inline size_t assay_record_head_bytes_(unsigned char* out, unsigned major, uint64_t n) {
  const int log = n < 256u ? 0 : n < 65536u ? 1 : n <= 0xFFFFFFFFu ? 2 : 3;
  if (n < 24u) {
    out[0] = (unsigned char)(major << 5 | (unsigned)n);
    return 1;
  }
  out[0] = (unsigned char)(major << 5 | (24u + (unsigned)log));
  assay_record_big_endian_(out + 1, n, 1 << log);
  return (size_t)1 + ((size_t)1 << log);
}

static inline void assay_record_head_(assay_recorder* r, unsigned major, uint64_t n) {
  unsigned char bytes[9];
  assay_record_put_(r, bytes, assay_record_head_bytes_(bytes, major, n));
}

/* Returns the number of bytes of the UTF-8 character that begins at p; 0 if none does. */
static inline size_t assay_record_utf8_(const unsigned char* p) {
  const size_t n = *p < 0x80u ? 1 : *p < 0xC2u ? 0 : *p < 0xE0u ? 2 : *p < 0xF0u ? 3 : 4;
  size_t i;
  if (*p > 0xF4u) return 0;
  for (i = 1; i < n; ++i)
    if ((p[i] & 0xC0u) != 0x80u) return 0;
  if ((*p == 0xE0u && p[1] < 0xA0u) || (*p == 0xEDu && p[1] > 0x9Fu)) return 0;
  return (*p == 0xF0u && p[1] < 0x90u) || (*p == 0xF4u && p[1] > 0x8Fu) ? 0 : n;
}

static inline void assay_record_text_(assay_recorder* r, const char* text) {
  const unsigned char* p = (const unsigned char*)text;
  assay_record_head_(r, 3, strlen(text));
  while (*p) {
    const size_t n = assay_record_utf8_(p);
    assay_record_put_(r, n ? (const void*)p : (const void*)"?", n ? n : 1);
    p += n ? n : 1;
  }
}

static inline void assay_record_key_(assay_recorder* r, const char* key) {
  ++r->keys;
  assay_record_text_(r, key);
}

static inline void assay_record_integer_(assay_recorder* r, const char* key, int64_t value) {
  assay_record_key_(r, key);
  if (value < 0)
    assay_record_head_(r, 1, (uint64_t)(-(value + 1)));
  else
    assay_record_head_(r, 0, (uint64_t)value);
}

static inline void assay_record_count_(assay_recorder* r, const char* key, uint64_t value) {
  assay_record_key_(r, key);
  assay_record_head_(r, 0, value);
}

static inline void assay_record_words_(assay_recorder* r, const char* key, const char* text) {
  assay_record_key_(r, key);
  assay_record_text_(r, text);
}

static inline void assay_record_real_(assay_recorder* r, const char* key, double value) {
  unsigned char bytes[9];
  uint64_t bits;
  memcpy(&bits, &value, sizeof bits);
  bytes[0] = 0xFBu;
  assay_record_big_endian_(bytes + 1, bits, 8);
  assay_record_key_(r, key);
  assay_record_put_(r, bytes, sizeof bytes);
}

/* Writes a typed array of RFC 8746. big: its tag on a big-endian machine. On a little-endian
 * machine each tag is larger by 4. */
static inline void assay_record_typed_(assay_recorder* r, const char* key, unsigned big,
                                       const void* data, uint64_t bytes) {
  const uint16_t one = 1;
  assay_record_key_(r, key);
  assay_record_head_(r, 6, big + (*(const unsigned char*)&one == 1 ? 4u : 0u));
  assay_record_head_(r, 2, bytes);
  assay_record_put_(r, data, bytes);
}

static inline void assay_record_int32s_(assay_recorder* r, const char* key, const int32_t* data,
                                        uint64_t count) {
  assay_record_typed_(r, key, 74, data, 4 * count);
}

static inline void assay_record_doubles_(assay_recorder* r, const char* key, const double* data,
                                         uint64_t count) {
  assay_record_typed_(r, key, 82, data, 8 * count);
}

static inline void assay_record_vertices_(assay_recorder* r, const char* key,
                                          assay_record_array array) {
  if (array.data)
    assay_record_typed_(r, key, array.is_float32 ? 81 : 82, array.data,
                        (array.is_float32 ? 12u : 24u) * r->vertex_count);
}

/* Writes a map within the body. Its keys are not counted among the keys of the body. */
static inline void assay_record_counted_(assay_recorder* r, const assay_counted_pairs* c) {
  const uint64_t outside = r->keys;
  assay_record_head_(r, 5,
                     3u + (c->body ? 1u : 0u) + (c->apart_count ? 1u : 0u) + (c->rest ? 1u : 0u) +
                         (c->triangle_pair_count ? 1u : 0u) + (c->vertex_face_count ? 1u : 0u) +
                         (c->edge_pair_count ? 1u : 0u));
  assay_record_integer_(r, "level", c->level);
  assay_record_integer_(r, "rings", c->rings);
  assay_record_real_(r, "rest_distance", c->rest_distance);
  if (c->body) assay_record_int32s_(r, "body", c->body, r->vertex_count);
  if (c->apart_count) assay_record_int32s_(r, "apart", c->apart, 2 * c->apart_count);
  if (c->rest) assay_record_doubles_(r, "rest", c->rest, 3 * r->vertex_count);
  if (c->triangle_pair_count)
    assay_record_int32s_(r, "triangle_pairs", c->triangle_pairs, 2 * c->triangle_pair_count);
  if (c->vertex_face_count)
    assay_record_int32s_(r, "vertex_faces", c->vertex_faces, 2 * c->vertex_face_count);
  if (c->edge_pair_count)
    assay_record_int32s_(r, "edge_pairs", c->edge_pairs, 4 * c->edge_pair_count);
  r->keys = outside;
}

/* What is written into the body of a record. */
typedef struct assay_record_content_ {
  const assay_description* description;
  const int32_t* triangles;
  uint64_t triangle_count;
  assay_record_array positions;
  const assay_counted_pairs* counted;
  assay_record_array x0;
  const assay_record_step_data* step;
  const char* text;
} assay_record_content_;

static inline void assay_record_begin_body_(assay_recorder* r, const assay_record_content_* c) {
  const assay_description* d = c->description;
  assay_record_words_(r, "type", "begin");
  assay_record_count_(r, "log", 1);
  assay_record_count_(r, "record", 0);
  assay_record_words_(r, "name", d->name);
  assay_record_words_(r, "version", d->version ? d->version : "");
  assay_record_count_(r, "claims", d->claims);
#define ASSAY_RECORD_MEMBER_(kind, name, since) assay_record_##kind##_(r, #name, d->name);
  ASSAY_CONTRACT_MEMBERS(ASSAY_RECORD_MEMBER_)
#undef ASSAY_RECORD_MEMBER_
  assay_record_count_(r, "vertices", r->vertex_count);
  assay_record_int32s_(r, "triangles", c->triangles, 3 * c->triangle_count);
  assay_record_vertices_(r, "positions", c->positions);
  if (c->counted) {
    assay_record_key_(r, "counted");
    assay_record_counted_(r, c->counted);
  }
}

static inline void assay_record_answer_(assay_recorder* r, const assay_result* result) {
  assay_record_integer_(r, "answer", result->answer);
  if (result->answer == ASSAY_COLLISION) {
    assay_record_real_(r, "first_lo", result->first_lo);
    assay_record_real_(r, "first_hi", result->first_hi);
  }
  if (result->pair_count) {
    assay_record_int32s_(r, "pairs", result->pairs, 2 * result->pair_count);
    if (result->pair_times)
      assay_record_doubles_(r, "pair_times", result->pair_times, 2 * result->pair_count);
  }
  if (result->message) assay_record_words_(r, "message", result->message);
}

static inline void assay_record_step_body_(assay_recorder* r, const assay_record_content_* c) {
  const assay_record_step_data* s = c->step;
  assay_record_words_(r, "type", "step");
  assay_record_count_(r, "record", r->next_record);
  assay_record_count_(r, "step", r->next_step);
  assay_record_vertices_(r, "x0", c->x0);
  assay_record_vertices_(r, "x1", s->x1);
  assay_record_vertices_(r, "dx", s->dx);
  assay_record_vertices_(r, "committed", s->committed);
  if (s->result) assay_record_answer_(r, s->result);
  if (s->limit && s->limit->share != -1) /* -1: the share is not stated */
    assay_record_real_(r, "share", s->limit->share);
  if (s->limit && s->limit->positions)
    assay_record_doubles_(r, "positions", s->limit->positions, 3 * r->vertex_count);
}

static inline void assay_record_note_body_(assay_recorder* r, const assay_record_content_* c) {
  assay_record_words_(r, "type", "note");
  assay_record_count_(r, "record", r->next_record);
  assay_record_count_(r, "step", r->next_step);
  assay_record_words_(r, "text", c->text);
}

static inline void assay_record_end_body_(assay_recorder* r, const assay_record_content_* c) {
  (void)c;
  assay_record_words_(r, "type", "end");
  assay_record_count_(r, "record", r->next_record);
  assay_record_count_(r, "steps", r->next_step);
}

typedef void (*assay_record_body_)(assay_recorder*, const assay_record_content_*);

/* Writes a record. Goes through its body twice, the first time only to compute its size. */
static inline int32_t assay_record_write_(assay_recorder* r, assay_record_body_ body,
                                          const assay_record_content_* content) {
  unsigned char head[9], frame[17] = {0x83, 0x44, 'A', 'S', 'R', '1', 0xD8, 0x18, 0x5B};
  r->is_counted = 1;
  r->body_size = r->keys = 0;
  body(r, content);
  r->is_counted = 0;
  assay_record_big_endian_(frame + 9, r->body_size + assay_record_head_bytes_(head, 5, r->keys), 8);
  r->crc = 0xFFFFFFFFu;
  assay_record_raw_(r, frame, sizeof frame);
  assay_record_head_(r, 5, r->keys);
  body(r, content);
  frame[0] = 0x1A;
  assay_record_big_endian_(frame + 1, r->crc ^ 0xFFFFFFFFu, 4);
  assay_record_raw_(r, frame, 5);
  assay_record_flush_(r);
  ++r->next_record;
  if (!r->has_failed) return ASSAY_OK;
  return assay_record_fail_(r, ASSAY_RECORD_NOT_WRITTEN, "cannot write to", r->path, r->reason);
}

static inline int32_t assay_record_is_there_(const char* path) {
  FILE* file = fopen(path, "rb");
  const int32_t is_there = file && fgetc(file) != EOF;
  if (file) (void)fclose(file);
  return is_there;
}

static inline void assay_record_free_(assay_recorder* r) {
  if (r->file) (void)fclose(r->file);
  free(r->path);
  free(r->end);
  r->file = NULL;
  r->path = NULL;
  r->end = NULL;
  r->is_begun = 0;
}

static inline int32_t assay_record_wrong_(assay_recorder* r, const char* what) {
  return assay_record_fail_(r, ASSAY_RECORD_WRONG_ARGUMENT, what, "", 0);
}

static inline int32_t assay_record_check_mesh_(assay_recorder* r, const assay_record_content_* c,
                                               uint64_t vertex_count) {
  uint64_t i;
  if (!c->description || !c->description->name)
    return assay_record_wrong_(r, "the description or its name is missing");
  if (!c->positions.data || vertex_count == 0 || vertex_count > INT32_MAX)
    return assay_record_wrong_(r, "the positions are missing, or there are more than 2^31 - 1");
  if (c->triangle_count > INT32_MAX || (!c->triangles && c->triangle_count))
    return assay_record_wrong_(r, "the triangles are missing, or there are more than 2^31 - 1");
  for (i = 0; i < 3 * c->triangle_count; ++i)
    if (c->triangles[i] < 0 || (uint64_t)c->triangles[i] >= vertex_count)
      return assay_record_wrong_(r, "a triangle names a vertex that does not exist");
  if (c->counted && ((c->counted->apart_count && !c->counted->apart) ||
                     (c->counted->rest_distance > 0 && !c->counted->rest) ||
                     (c->counted->triangle_pair_count && !c->counted->triangle_pairs) ||
                     (c->counted->vertex_face_count && !c->counted->vertex_faces) ||
                     (c->counted->edge_pair_count && !c->counted->edge_pairs)))
    return assay_record_wrong_(r, "an array of `counted` is missing");
  return ASSAY_OK;
}

/* Allocates memory and opens the file. REQUIRES that all arguments were checked before. */
static inline int32_t assay_record_open_(assay_recorder* r, const assay_record_settings* s) {
  const size_t length = strlen(s->path) + 1;
  r->every = s->every ? s->every : 1;
  r->path = (char*)malloc(length);
  if (r->every > 1) r->end = malloc((size_t)(24u * r->vertex_count));
  if (!r->path || (r->every > 1 && !r->end))
    return assay_record_fail_(r, ASSAY_OUT_OF_MEMORY, "out of memory", "", 0);
  memcpy(r->path, s->path, length);
  if (!s->overwrite && assay_record_is_there_(r->path))
    return assay_record_fail_(r, ASSAY_RECORD_FILE_EXISTS, "there is already a file", r->path, 0);
  assay_record_make_tables_(r);
  errno = 0;
  r->file = fopen(r->path, "wb");
  if (!r->file)
    return assay_record_fail_(r, ASSAY_RECORD_NOT_OPENED, "cannot open", r->path, errno);
  (void)setvbuf(r->file, NULL, _IONBF, 0);
  return ASSAY_OK;
}

static inline int32_t assay_record_begin(assay_recorder* recorder,
                                         const assay_record_settings* settings,
                                         const assay_description* description,
                                         const int32_t* triangles, uint64_t triangle_count,
                                         assay_record_array positions, uint64_t vertex_count,
                                         const assay_counted_pairs* counted) {
  assay_record_content_ content;
  int32_t code;
  memset(recorder, 0, sizeof *recorder);
  memset(&content, 0, sizeof content);
  content.description = description;
  content.triangles = triangles;
  content.triangle_count = triangle_count;
  content.positions = positions;
  content.counted = counted;
  if (!settings || !settings->path || !*settings->path)
    return assay_record_wrong_(recorder, "the path is missing");
  if (settings->overwrite != 0 && settings->overwrite != 1)
    return assay_record_wrong_(recorder, "`overwrite` must be 0 or 1");
  code = assay_record_check_mesh_(recorder, &content, vertex_count);
  if (code != ASSAY_OK) return code;
  recorder->vertex_count = vertex_count;
  recorder->triangle_count = (int32_t)triangle_count;
  code = assay_record_open_(recorder, settings);
  if (code == ASSAY_OK) code = assay_record_write_(recorder, assay_record_begin_body_, &content);
  if (code != ASSAY_OK)
    assay_record_free_(recorder);
  else
    recorder->is_begun = 1;
  return code;
}

/* Returns whether lo <= hi, both in [0, 1]; 0 for a NaN. */
static inline int assay_record_is_time_(double lo, double hi) {
  return 0 <= lo && lo <= hi && hi <= 1;
}

static inline int32_t assay_record_no_answer_(assay_recorder* r, const char* what) {
  return assay_record_fail_(r, ASSAY_RECORD_NO_ANSWER, what, "", 0);
}

static inline int32_t assay_record_check_answer_(assay_recorder* r, const assay_result* result,
                                                 const assay_limit* limit) {
  const int is_judged = result && result->answer <= ASSAY_UNDECIDED;
  uint64_t i;
  if (result && result->answer == ASSAY_COLLISION &&
      !assay_record_is_time_(result->first_lo, result->first_hi))
    return assay_record_no_answer_(r, "the first time is no interval in [0, 1]");
  if (result && result->answer == ASSAY_FREE && result->pair_count)
    return assay_record_no_answer_(r, "the answer is `free`, but pairs are given");
  for (i = 0; is_judged && i < result->pair_count; ++i) {
    const int32_t a = result->pairs[2 * i], b = result->pairs[2 * i + 1];
    if (a < 0 || b < 0 || a == b || a >= r->triangle_count || b >= r->triangle_count)
      return assay_record_no_answer_(r, "a pair does not name two triangles of the mesh");
    if (result->pair_times &&
        !assay_record_is_time_(result->pair_times[2 * i], result->pair_times[2 * i + 1]))
      return assay_record_no_answer_(r, "the time of a pair is no interval in [0, 1]");
  }
  if (limit && limit->share != -1 && !(0 <= limit->share && limit->share <= 1))
    return assay_record_no_answer_(r, "the share of a limit must be from 0 to 1, or -1");
  for (i = 0; limit && limit->positions && i < 3 * r->vertex_count; ++i)
    if (!(limit->positions[i] - limit->positions[i] == 0))
      return assay_record_no_answer_(r, "the positions of a limit are not finite");
  return ASSAY_OK;
}

static inline int32_t assay_record_check_step_(assay_recorder* r,
                                               const assay_record_step_data* step) {
  const assay_result* result = step ? step->result : NULL;
  if (!r->is_begun)
    return assay_record_fail_(r, ASSAY_RECORD_NOT_BEGUN, "nothing is being recorded", "", 0);
  if (!step || !step->x1.data == !step->dx.data)
    return assay_record_wrong_(r, "a step needs either x1 or dx");
  if (result && (result->answer < ASSAY_FREE || result->answer > ASSAY_BEYOND_CAPACITY))
    return assay_record_wrong_(r, "the answer has an unknown value");
  if (result && result->pair_count && !result->pairs)
    return assay_record_wrong_(r, "the pairs are missing");
  if (!step->x0.data && !r->end_is_known)
    return assay_record_fail_(r, ASSAY_RECORD_NO_START,
                              "x0 is missing, and the end of the last step is not known", "", 0);
  return assay_record_check_answer_(r, result, step->limit);
}

static inline int32_t assay_record_step(assay_recorder* recorder,
                                        const assay_record_step_data* step) {
  assay_recorder* const r = recorder;
  assay_record_content_ content;
  assay_record_array end;
  int32_t code = assay_record_check_step_(r, step);
  if (code != ASSAY_OK) return code;
  end = step->committed.data ? step->committed : step->x1;
  if (r->next_step % r->every == 0) {
    memset(&content, 0, sizeof content);
    content.step = step;
    content.x0 = step->x0;
    if (!step->x0.data && r->every > 1) {
      content.x0.data = r->end;
      content.x0.is_float32 = r->end_is_float32;
    }
    code = assay_record_write_(r, assay_record_step_body_, &content);
  }
  ++r->next_step;
  r->end_is_known = end.data != NULL;
  if (end.data && r->every > 1 && r->next_step % r->every == 0) {
    memcpy(r->end, end.data, (size_t)((end.is_float32 ? 12u : 24u) * r->vertex_count));
    r->end_is_float32 = end.is_float32;
  }
  return code;
}

static inline int32_t assay_record_note(assay_recorder* recorder, const char* text) {
  assay_record_content_ content;
  memset(&content, 0, sizeof content);
  content.text = text;
  if (!recorder->is_begun)
    return assay_record_fail_(recorder, ASSAY_RECORD_NOT_BEGUN, "nothing is being recorded", "", 0);
  if (!text) return assay_record_wrong_(recorder, "the text is missing");
  return assay_record_write_(recorder, assay_record_note_body_, &content);
}

static inline int32_t assay_record_end(assay_recorder* recorder) {
  assay_record_content_ content;
  int32_t code;
  if (!recorder->is_begun)
    return assay_record_fail_(recorder, ASSAY_RECORD_NOT_BEGUN, "nothing is being recorded", "", 0);
  memset(&content, 0, sizeof content);
  code = assay_record_write_(recorder, assay_record_end_body_, &content);
  if (recorder->file && fclose(recorder->file) != 0 && code == ASSAY_OK)
    code = assay_record_fail_(recorder, ASSAY_RECORD_NOT_WRITTEN, "cannot close", recorder->path,
                              errno);
  recorder->file = NULL;
  assay_record_free_(recorder);
  return code;
}

static inline const char* assay_record_error(const assay_recorder* recorder) {
  return recorder->error;
}

#endif
