//! Bibliography: one documented constant a paper, for doc comments to link to.

/// K. P. Picott, *Extensions of the Linear and Area Lighting Models*, IEEE Computer Graphics and Applications 12(2), 1992.
pub const PICOTT_1992: &str = "Picott 1992";

/// P. Poulin and J. Amanatides, *Shading and Shadowing with Linear Light Sources*, Eurographics 1990.
pub const POULIN_AMANATIDES_1990: &str = "Poulin & Amanatides 1990";

/// J. M. Snyder, *Area Light Sources for Real-Time Graphics*, Microsoft Research MSR-TR-96-11, 1996.
pub const SNYDER_1996: &str = "Snyder 1996";

/// *One-Shot Approximate Local Shading*: a textured area light as one point light a shading component.
pub const ONE_SHOT: &str = "One-Shot Approximate Local Shading";

/// J. Arvo, *Applications of Irradiance Tensors to the Simulation of Non-Lambertian Phenomena*, SIGGRAPH 1995.
pub const ARVO_1995: &str = "Arvo 1995";

/// T. Nishita and E. Nakamae, *Continuous Tone Representation of Three-Dimensional Objects Taking Account of Shadows
/// and Interreflection*, SIGGRAPH 1985.
pub const NISHITA_NAKAMAE_1985: &str = "Nishita & Nakamae 1985";

/// J. F. Blinn, *Models of Light Reflection for Computer Synthesized Pictures*, SIGGRAPH 1977.
pub const BLINN_1977: &str = "Blinn 1977";

/// R. L. Cook and K. E. Torrance, *A Reflectance Model for Computer Graphics*, ACM Transactions on Graphics 1(1), 1982.
pub const COOK_TORRANCE_1982: &str = "Cook & Torrance 1982";

/// E. P. F. Lafortune, S.-C. Foo, K. E. Torrance and D. P. Greenberg, *Non-Linear Approximation of Reflectance
/// Functions*, SIGGRAPH 1997.
pub const LAFORTUNE_1997: &str = "Lafortune et al. 1997";

/// B. Burley, *Practical Hash-Based Owen Scrambling*, Journal of Computer Graphics Techniques 9(4), 2020.
pub const BURLEY_2020: &str = "Burley 2020";

/// P. Shirley and K. Chiu, *A Low Distortion Map Between Disk and Square*, Journal of Graphics Tools 2(3), 1997.
pub const SHIRLEY_CHIU_1997: &str = "Shirley & Chiu 1997";

/// E. Veach and L. J. Guibas, *Optimally Combining Sampling Techniques for Monte Carlo Rendering*, SIGGRAPH 1995.
pub const VEACH_GUIBAS_1995: &str = "Veach & Guibas 1995";

/// I. M. Sobol, *On the Distribution of Points in a Cube and the Approximate Evaluation of Integrals*, USSR Computational
/// Mathematics and Mathematical Physics 7(4), 1967.
pub const SOBOL_1967: &str = "Sobol 1967";

/// A. B. Owen, *Randomly Permuted (t,m,s)-Nets and (t,s)-Sequences*, Monte Carlo and Quasi-Monte Carlo Methods in
/// Scientific Computing, 1995.
pub const OWEN_1995: &str = "Owen 1995";

/// S. Laine and T. Karras, *Stratified Sampling for Stochastic Transparency*, Computer Graphics Forum 30(4), 2011.
pub const LAINE_KARRAS_2011: &str = "Laine & Karras 2011";

/// M. Jarzynski and M. Olano, *Hash Functions for GPU Rendering*, Journal of Computer Graphics Techniques 9(3), 2020.
pub const JARZYNSKI_OLANO_2020: &str = "Jarzynski & Olano 2020";

/// T. Duff, J. Burgess, P. Christensen, C. Hery, A. Kensler, M. Liani and R. Villemin, *Building an Orthonormal Basis,
/// Revisited*, Journal of Computer Graphics Techniques 6(1), 2017.
pub const DUFF_2017: &str = "Duff et al. 2017";

/// Illuminating Engineering Society of North America, *Standard File Format for the Electronic Transfer of Photometric
/// Data*, ANSI/IESNA LM-63-02, 2002.
pub const LM_63: &str = "ANSI/IESNA LM-63-02";
