// The sum of a row's partial products, and of the sum so far where the matrix has several tiles side by side.
uniform sampler2D parts[GROUPS];
uniform sampler2D previous[GROUPS];
uniform int splits;
uniform int accumulate;

void main()
{
  ivec2 place = ivec2(gl_FragCoord.xy);
  vec4 sum[GROUPS];
  vec4 lost[GROUPS];
#define CLEAR(g) sum[g] = accumulate != 0 ? texelFetch(previous[g], place, 0) : vec4(0.0); lost[g] = vec4(0.0);
  FOR_ALL_GROUPS(CLEAR)
  for (int split = 0; split < splits; ++split)
  {
    ivec2 from = ivec2(place.x, place.y * splits + split);
#define ADD(g) AddCompensated(sum[g], lost[g], texelFetch(parts[g], from, 0));
    FOR_ALL_GROUPS(ADD)
  }
#define STORE(g) result[g] = sum[g] + lost[g];
  FOR_ALL_GROUPS(STORE)
}
