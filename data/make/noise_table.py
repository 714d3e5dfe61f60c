exec(open('/tmp/perm.py').read().split('# entry')[0])
q=p+p+p[:2]
def field(c): return {0:0,1:0x7f,-1:0x17f}[c]
def grad(h):
    h&=15
    u=[0,0,0]
    iu=0 if h<8 else 1
    iv=1 if h<4 else (0 if h in(12,14) else 2)
    u[iu]+= -1 if h&1 else 1
    u[iv]+= -1 if h&2 else 1
    return u
hash_rows=[]
for i in range(0,512,16):
    hash_rows.append("    "+", ".join("%5d"%(q[j]|q[j+1]<<8) for j in range(i,i+16))+",")
grad_rows=[]
vals=[]
for j in range(514):
    g=grad(q[j]); vals.append(field(g[0])<<23|field(g[1])<<14|field(g[2])<<5)
for i in range(0,514,8):
    grad_rows.append("    "+", ".join("0x%08x"%v for v in vals[i:i+8])+",")
open('sources/noise_table.clh','w').write('''// Tables of Perlin's 2002 reference noise, packed so that the eight corners of a cell need 7 loads instead of 14 for the
// hashes, and no arithmetic to choose gradients. data/make/noise_table.py prints this file.

// p[i] in the low byte, p[i + 1] in the high one; the permutation twice over.
constant ushort wr_perlin_hash[512] = {
'''+"\n".join(hash_rows)+'''
};

// The gradient of hash p[i]: components -1, 0 or 1, each as the top 9 bits of its float, x first.
constant uint wr_perlin_gradient[514] = {
'''+"\n".join(grad_rows)+'''
};
''')
