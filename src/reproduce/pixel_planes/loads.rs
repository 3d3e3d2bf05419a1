//! The primitives of the busiest renderer, P_w: counted for all numbers of renderers, without time.

use super::plan::{Plan, RENDERERS};
use super::scenes::{Subject, Which};
use crate::shell::Failure;
use tilewright_machines::pixel_planes::{Binner, Bins, Config, Outline, Regions, allocate};
use tilewright_machines::{Error, Watch};
use tilewright_report::Origin;

/// The bins of a scene.
pub struct Load {
    pub name: &'static str,
    pub seeds: Vec<u64>,
    /// Primitives, P.
    pub primitives: u64,
    /// Those that are in one region alone.
    pub in_one: u64,
    /// Primitives of each region.
    pub bins: Vec<u64>,
}

impl Load {
    /// The bins of a scene, as the machine bins it.
    pub fn of(subject: &Subject, regions: &Regions) -> Load {
        let vertices = &subject.scene.vertices;
        let of_primitive = |vertices: &Vec<_>| regions.of(&Outline::of(vertices), Binner::Tight);
        let mut load = Load {
            name: subject.name,
            seeds: subject.seeds.clone(),
            primitives: vertices.len() as u64,
            in_one: 0,
            bins: vec![0; regions.count()],
        };
        for regions in vertices.iter().map(of_primitive) {
            load.in_one += u64::from(regions.len() == 1);
            regions.into_iter().for_each(|region| load.bins[region] += 1);
        }
        load
    }

    pub fn origin(&self) -> Origin {
        Origin::count(self.seeds.clone())
    }

    /// Primitives in all bins.
    pub fn binned(&self) -> u64 {
        self.bins.iter().sum()
    }

    /// Mean number of regions of a primitive.
    pub fn regions(&self) -> f64 {
        self.binned() as f64 / self.primitives as f64
    }

    /// P_w of that number of renderers. Each gets the next region when it has drawn the primitives of the one before.
    pub fn worst(&self, renderers: u32) -> u64 {
        allocate(&self.bins, renderers as usize, |size| size).worst_load()
    }

    /// P_w over the mean load.
    pub fn imbalance(&self, renderers: u32) -> f64 {
        self.worst(renderers) as f64 * f64::from(renderers) / self.binned() as f64
    }

    /// P/B.
    pub fn least(&self, renderers: u32) -> f64 {
        tilewright_machines::pixel_planes::least_load(self.primitives as f64, renderers as usize)
    }
}

/// Random vectors of the paper.
pub struct Crowd {
    pub vectors: u64,
    /// P_w of [`RENDERERS`] renderers.
    pub worst: Bins<u64>,
}

/// All counts.
pub struct Loads {
    pub regions: Regions,
    pub scenes: Vec<Load>,
    pub crowds: Vec<Crowd>,
    seed: u64,
}

/// All possible numbers of renderers.
pub fn renderers() -> impl Iterator<Item = u32> {
    1..=Config::MOST_RENDERERS
}

impl Loads {
    /// Counts; `None` if interrupted.
    pub fn all(plan: &Plan, watch: &mut Watch) -> Result<Option<Loads>, Failure> {
        let regions = plan.regions();
        let load = |which: &Which| Ok::<Load, Failure>(Load::of(&which.subject(plan)?, &regions));
        let Some(scenes) = watch.each("binning", &plan.scenes(), load) else { return Ok(None) };
        let vectors = plan.vectors().map_err(Error::from)?;
        let count = |crowd: &u64| {
            let ends = (0..*crowd).map(|number| vectors.ends(number));
            Crowd::of(&ends.map(|ends| Outline::of(&ends)).collect::<Vec<_>>(), &regions)
        };
        let Some(crowds) = watch.each("counting loads", &plan.crowds(), count) else { return Ok(None) };
        Ok(Some(Loads {
            regions,
            scenes: scenes.into_iter().collect::<Result<_, _>>()?,
            crowds,
            seed: plan.effort.seed,
        }))
    }

    /// The random vectors.
    pub fn origin(&self) -> Origin {
        Origin::count([self.seed])
    }

    pub fn of(&self, name: &str) -> Option<&Load> {
        self.scenes.iter().find(|load| load.name == name)
    }
}

impl Crowd {
    fn of(vectors: &[Outline], regions: &Regions) -> Crowd {
        let bins = |binner: Binner| {
            let mut bins = vec![0; regions.count()];
            vectors.iter().flat_map(|vector| regions.of(vector, binner)).for_each(|region| bins[region] += 1);
            bins
        };
        let bins = [Binner::Box, Binner::Columns, Binner::Tight].map(bins);
        let [by_box, by_columns, tight] =
            bins.map(|bins| allocate(&bins, RENDERERS as usize, |size| size).worst_load());
        Crowd { vectors: vectors.len() as u64, worst: Bins { by_box, by_columns, tight } }
    }
}
