//! A frame to draw: a view of the scene, with its polygons assigned to processing elements.

use std::cell::RefCell;
use std::collections::{BTreeMap, VecDeque};
use std::rc::Rc;
use std::sync::Arc;

use tilewright_rtl::parameter::ParameterError;
use tilewright_scenes::{Projection, ScreenVertex, Size, Triangle, set_up};

use super::assignment::{Assignment, Polygon};
use super::config::Config;
use super::demand::demand;

/// The result of the processing elements' geometry for a view of the scene.
#[derive(Debug)]
pub(crate) struct View {
    pub assignment: Assignment,
    pub projection: Arc<Projection>,
}

impl View {
    /// `first` is the assignment of the first view, unless this is it.
    ///
    /// # Errors
    /// The projection is for another screen, or of another scene than the first one.
    pub fn new(
        config: &Config,
        projection: Arc<Projection>,
        first: Option<&Assignment>,
    ) -> Result<View, ParameterError> {
        let (asked, size) = (projection.size, config.size);
        if asked != size {
            let problem = format!("a projection of {asked} pixels on a machine of {size}: project the scene again");
            return Err(ParameterError(problem));
        }
        Ok(View { assignment: config.assignment(&projection, first)?, projection })
    }

    /// The polygons of a processing element.
    pub fn polygons(&self, processor: u32) -> &[Polygon] {
        &self.assignment.polygons[processor as usize]
    }
}

impl Config {
    /// The pages in each buffer with which no processing element overflows in the frames of these consecutive views.
    ///
    /// ```
    /// use tilewright_machines::vc1::Config;
    /// use tilewright_scenes::Scene;
    ///
    /// let projection = Scene::builtin("teapot").expect("a built-in scene").project()?;
    /// let config = Config::new(projection.size);
    /// assert!(config.sufficient_pages([projection])? <= config.pages()?);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// As [`Config::patches`].
    pub fn sufficient_pages(&self, views: impl IntoIterator<Item = Projection>) -> Result<u32, ParameterError> {
        let (patches, mut first, mut pages) = (self.patches()?, None, 0);
        for view in views {
            let assignment = self.assignment(&view, first.as_ref())?;
            let demand = demand(&assignment, &view.triangles, &patches, self.apr);
            pages = demand.iter().map(|it| it.pages).fold(pages, u32::max);
            first.get_or_insert(assignment);
        }
        Ok(pages)
    }
}

/// The views by frame, shared by all processing elements.
#[derive(Clone, Debug, Default)]
pub(crate) struct Views {
    views: Rc<RefCell<BTreeMap<u32, Arc<View>>>>,
    /// The last packets that all processing elements set up and draw.
    set_ups: Rc<RefCell<VecDeque<SetUp>>>,
}

/// A polygon's vertices, and its packet if it has pixels.
type SetUp = ([ScreenVertex; 3], Option<Rc<Triangle>>);

/// A number of polygons larger than the usual queue.
const KEPT: usize = 16;

impl Views {
    /// The view of a frame, if the host has commanded it.
    pub fn of(&self, frame: u32) -> Option<Arc<View>> {
        self.views.borrow().get(&frame).cloned()
    }

    pub fn insert(&self, frame: u32, view: Arc<View>) {
        self.views.borrow_mut().insert(frame, view);
    }

    pub fn remove(&self, frame: u32) {
        self.views.borrow_mut().remove(&frame);
    }

    /// The packet of a polygon; `None` if it has no pixel. All calls have the same screen size.
    pub fn set_up(&self, vertices: &[ScreenVertex; 3], size: Size) -> Option<Rc<Triangle>> {
        let mut known = self.set_ups.borrow_mut();
        if let Some((_, packet)) = known.iter().find(|(of, _)| of == vertices) {
            return packet.clone();
        }
        let packet = set_up(vertices, size).map(Rc::new);
        if known.len() == KEPT {
            known.pop_back();
        }
        known.push_front((*vertices, packet.clone()));
        packet
    }
}
