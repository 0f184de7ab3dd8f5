// One range of columns of the product of a matrix tile with a vector. Fragment (x, y) computes the row (y / splits) * width + x
// over the (y % splits)-th range of columns.
uniform sampler2D matrix[MATRIX_GROUPS];
uniform sampler2D vector[GROUPS];
uniform int width;
uniform int splits;
uniform int numberOfRows;
uniform int firstRow;
uniform int firstColumn;
uniform int numberOfTexels;
uniform int texelsPerSplit;

// Texels summed plainly before their sum is added with compensation.
const int BLOCK = 16;

void main()
{
  ivec2 place = ivec2(gl_FragCoord.xy);
  int row = (place.y / splits) * width + place.x;
  int begin = (place.y % splits) * texelsPerSplit;
  int end = row < numberOfRows ? min(begin + texelsPerSplit, numberOfTexels) : begin;
  vec4 sum[GROUPS];
  vec4 lost[GROUPS];
  vec4 part[GROUPS];
#define CLEAR(g) sum[g] = vec4(0.0); lost[g] = vec4(0.0);
  FOR_ALL_GROUPS(CLEAR)
  for (int block = begin; block < end; block += BLOCK)
  {
#define CLEAR_PART(g) part[g] = vec4(0.0);
    FOR_ALL_GROUPS(CLEAR_PART)
    int last = min(block + BLOCK, end);
    for (int texel = block; texel < last; ++texel)
    {
      ivec2 from = ivec2(texel, row - firstRow);
#if SHARED_KERNEL
      // A texel holds four columns; the vector's rows hold a multiple of four patches.
      int column = firstColumn + 4 * texel;
      ivec2 at = ivec2(column % width, column / width);
      vec4 links = texelFetch(matrix[0], from, 0);
#define ADD(g) part[g] += (links.x * texelFetch(vector[g], at, 0) + links.y * texelFetch(vector[g], at + ivec2(1, 0), 0)) + (links.z * texelFetch(vector[g], at + ivec2(2, 0), 0) + links.w * texelFetch(vector[g], at + ivec2(3, 0), 0));
#else
      // A texel holds one column of four bands.
      int column = firstColumn + texel;
      ivec2 at = ivec2(column % width, column / width);
#define ADD(g) part[g] += texelFetch(matrix[g], from, 0) * texelFetch(vector[g], at, 0);
#endif
      FOR_ALL_GROUPS(ADD)
    }
#define ADD_PART(g) AddCompensated(sum[g], lost[g], part[g]);
    FOR_ALL_GROUPS(ADD_PART)
  }
#define STORE(g) result[g] = sum[g] + lost[g];
  FOR_ALL_GROUPS(STORE)
}
